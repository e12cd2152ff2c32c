#include "cli/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>

#include "cli/dependency_options.h"
#include "cli/help.h"
#include "cli/verbs.h"
#include "popup/compile.h"

namespace popup::cli {

std::span<const Verb> verb_table() {
    static constexpr Verb kVerbs[] = {{add_build, run_build},
                                      {add_check, run_check},
                                      {add_fix, run_fix},
                                      {add_batch, run_batch},
                                      {add_merge_reports, run_merge_reports},
                                      {add_explain, run_explain},
                                      {add_list, run_list}};
    return kVerbs;
}

std::variant<Command, std::string> read_command(std::vector<std::string> arguments) {
    Command command;
    command.options.arguments = arguments;
    CLI::App app{"A batch compiler for pop-up paper designs: documents in, cut sheets and a moving model out",
                 "popupc"};
    set_up_help(app);
    std::vector<CLI::App*> verbs;
    for (const Verb& verb : verb_table()) {
        verbs.push_back(verb.add(app, command.options));
        verbs.back()->get_help_ptr()->group("Other");
    }
    app.require_subcommand(1);
    arguments = with_long_dependency_options(arguments);
    // The parser takes them from the end.
    std::reverse(arguments.begin(), arguments.end());
    try {
        app.parse(std::move(arguments));
    } catch (const CLI::CallForHelp&) {
        return help_text(app);
    } catch (const CLI::CallForVersion&) {
        return fmt::format("popupc {}\n", version());
    } catch (const CLI::ParseError& error) {
        throw explained(app, error);
    }
    for (std::size_t i = 0; i < verbs.size(); ++i) {
        if (verbs[i]->parsed()) command.verb = &verb_table()[i];
    }
    return command;
}

}  // namespace popup::cli
