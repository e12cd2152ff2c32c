// The command line: options in, diagnostics and an exit code out. No geometry here.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#endif

#include <algorithm>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <new>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "cli/options/command_line.h"
#include "cli/report.h"

namespace popup::cli {
namespace {

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

// What is freed is soon wanted again, by the next stage, design or keystroke. By default the C library gives
// blocks of more than 128 KB and the end of the heap back at once, and the kernel clears them anew.
void keep_freed_memory() {
#ifdef __GLIBC__
    constexpr int kMiB = 1 << 20;
    ::mallopt(M_TRIM_THRESHOLD, 256 * kMiB);
    ::mallopt(M_MMAP_THRESHOLD, 32 * kMiB);
    // A small card touches a thousand pages of 4 KiB, and each costs a page fault. The heap takes 16 MiB of
    // addresses at once, and asks the kernel to fill them with pages of 2 MiB.
    ::mallopt(M_TOP_PAD, 16 * kMiB);
    char* const from = static_cast<char*>(::sbrk(0));
    void* volatile block = std::malloc(kMiB);  // volatile: it is not left out
    std::free(block);
    char* const to = static_cast<char*>(::sbrk(0));
    if (to > from) ::madvise(from, static_cast<std::size_t>(to - from), MADV_HUGEPAGE);
#endif
}

int run(std::vector<std::string> arguments) {
    const std::variant<Command, std::string> wanted = read_command(std::move(arguments));
    if (const auto* text = std::get_if<std::string>(&wanted)) return print(*text) ? exit_done : exit_unusable;
    const Command& command = std::get<Command>(wanted);
    for (const UnknownVariable& one : command.options.unknown_variables)
        announce(command.options.messages, fmt::format("warning: the variable {} {}", one.name, one.why));
    return command.verb->run(command.options);
}

}  // namespace
}  // namespace popup::cli

// Any other exception is a mistake of ours and ends the program as loudly as a broken invariant.
int main(int argc, char** argv) {  // NOLINT(bugprone-exception-escape)
    using namespace popup::cli;
    settle_process();
    keep_freed_memory();
    std::set_new_handler(end_out_of_memory);
    try {
        return run({argv + std::min(argc, 1), argv + argc});
    } catch (const UsageError& error) {
        report_usage(error);
    } catch (const std::bad_alloc&) {
        report_usage(UsageError("there is not enough memory"));
    }
    return exit_unusable;
}
