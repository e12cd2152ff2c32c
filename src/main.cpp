// The command line: options in, diagnostics and an exit code out. No geometry here.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <new>

#include "cli/help.h"
#include "cli/report.h"
#include "cli/verbs.h"
#include "popup/compile.h"

namespace popup::cli {
namespace {

struct Verb {
    CLI::App* (*add)(CLI::App&, Options&);
    int (*run)(const Options&);
};
constexpr Verb kVerbs[] = {{add_build, run_build},
                           {add_check, run_check},
                           {add_fix, run_fix},
                           {add_explain, run_explain},
                           {add_list, run_list}};

// A reader that goes away and a file size limit are errors of write(), not deaths. A closed standard stream
// would give its number to the first file that is opened, which would then receive what was meant for the
// stream.
void settle_process() {
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; ++fd) {
        // Read-only for all: writing to a closed standard output stays an error.
        if (::fcntl(fd, F_GETFD) == -1 && ::open("/dev/null", O_RDONLY) < 0) std::_Exit(exit_unusable);
    }
}

int run(int argc, char** argv) {
    Options options;
    CLI::App app{"A batch compiler for pop-up paper designs: documents in, cut sheets and a moving model out",
                 "popupc"};
    set_up_help(app);
    std::vector<CLI::App*> verbs;
    for (const Verb& verb : kVerbs) {
        verbs.push_back(verb.add(app, options));
        verbs.back()->get_help_ptr()->group("Other");
    }
    app.require_subcommand(1);
    try {
        app.parse(argc, argv);
    } catch (const CLI::CallForHelp&) {
        return print(help_text(app)) ? exit_done : exit_unusable;
    } catch (const CLI::CallForVersion&) {
        return print(fmt::format("popupc {}\n", version())) ? exit_done : exit_unusable;
    } catch (const CLI::ParseError& error) {
        throw explained(app, error);
    }
    for (std::size_t i = 0; i < verbs.size(); ++i) {
        if (verbs[i]->parsed()) return kVerbs[i].run(options);
    }
    return exit_unusable;
}

}  // namespace
}  // namespace popup::cli

// Any other exception is a mistake of ours and ends the program as loudly as a broken invariant.
int main(int argc, char** argv) {  // NOLINT(bugprone-exception-escape)
    using namespace popup::cli;
    settle_process();
    try {
        return run(argc, argv);
    } catch (const UsageError& error) {
        report_usage(error);
    } catch (const std::bad_alloc&) {
        report_usage(UsageError("there is not enough memory"));
    }
    return exit_unusable;
}
