#include "cli/watch.h"

#include <fmt/format.h>
#include <sys/eventfd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <set>
#include <system_error>
#include <utility>
#include <variant>

#include "base/system/signal_cleanup.h"
#include "cli/build.h"
#include "cli/files/file_changes.h"
#include "cli/options/command_line.h"
#include "cli/options/config_file.h"
#include "cli/report.h"
#include "popup/files.h"

namespace popup::cli {
namespace {

std::atomic<bool> g_over{false};
std::atomic<int> g_wake{-1};

void wake_up() {
    const std::uint64_t one = 1;
    // Nothing can be done where it fails; the loop also asks after each build.
    [[maybe_unused]] const ssize_t put = ::write(g_wake.load(), &one, sizeof one);
}

std::atomic<bool> g_harmless{false};  // what is going on may be broken off

extern "C" void popup_stop_watching(int signal) {
    if (g_over.exchange(true)) end_by_signal(signal);
    if (g_harmless.load()) end_with(exit_done);
    wake_up();
}

// From now on SIGINT and SIGTERM end the loop. Gives a descriptor that becomes readable then.
int stop_on_signals() {
    const int wake = ::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
    if (wake < 0) throw UsageError("files cannot be watched: no more descriptors can be had");
    g_wake.store(wake);
    for (const int signal : {SIGINT, SIGTERM}) {
        struct sigaction before {};
        ::sigaction(signal, nullptr, &before);
        // Ignored on purpose: in the background of a script.
        if ((before.sa_flags & SA_SIGINFO) == 0 && before.sa_handler == SIG_IGN) continue;
        struct sigaction action {};
        action.sa_handler = popup_stop_watching;
        action.sa_flags = static_cast<int>(SA_RESTART);
        sigemptyset(&action.sa_mask);
        ::sigaction(signal, &action, nullptr);
    }
    return wake;
}

void refuse_streams(const Options& options) {
    const std::string who = "--watch builds again and again";
    check_watchable(options, who);
    bool standard = options.build.emit || options.messages.use_standard_output() ||
                    is_standard_output(options.messages.file) || is_standard_output(options.print.file) ||
                    is_standard_output(dependency_file_name(options));
    for (const std::string& output : options.build.outputs) standard = standard || is_standard_output(output);
    if (standard) {
        throw UsageError(who + ", and standard output takes one result",
                         {"name files for inputs, outputs and diagnostics"});
    }
}

bool has_any(const std::vector<FileFindings>& findings, const Diagnostics& run) {
    bool any = !run.sorted().empty();
    for (const FileFindings& one : findings) any = any || !one.diagnostics->sorted().empty();
    return any;
}

// One line for --verbose.
std::string line_of(const Build& done, const std::string& why) {
    std::string text = why.empty() ? "" : why + " has changed: ";
    if (done.files.empty()) return text + "nothing was written";
    text += "wrote " + done.files.front().path;
    const std::size_t more = done.files.size() - 1;
    if (more > 0) text += fmt::format(" and {} more file{}", more, more == 1 ? "" : "s");
    return text;
}

// A configuration may come to be where there is none.
void add_config_places(const Options& options, std::vector<std::string>& files) {
    if (options.config.off || !options.config.file.empty()) return;
    for (std::string& place : config_places(options.inputs.names.front())) files.push_back(std::move(place));
}

// Builds and tells; gives what was read, and what was looked for.
std::vector<std::string> build_and_tell(Options options, const Watched& watched, const std::string& why,
                                        std::set<std::string>& missing) {
    NestEffort& nesting = options.compile.layout.nesting;
    if (nesting.seconds) nesting.stop = &g_over;
    BuiltOf done = watched.build(options, why);
    std::vector<std::string> files = std::move(done.inputs);
    files.insert(files.end(), done.missing.begin(), done.missing.end());
    missing = {done.missing.begin(), done.missing.end()};
    add_config_places(options, files);
    return files;
}

// What programs load is looked at only when they have been run. True: the file may have changed since
// `begun`, or is gone. The clock of file systems is a little behind.
bool changed_since(const std::string& name, std::filesystem::file_time_type begun) {
    std::error_code error;
    const auto changed = std::filesystem::last_write_time(name, error);
    return error || changed >= begun - std::chrono::milliseconds(20);
}

// As long as one lives, the first signal may end the program.
class MayBreakOff {
 public:
    explicit MayBreakOff(bool may) { g_harmless.store(may); }
    MayBreakOff(const MayBreakOff&) = delete;
    MayBreakOff& operator=(const MayBreakOff&) = delete;
    ~MayBreakOff() { g_harmless.store(false); }
};

// The options as they are now: files that they are read from may be what has changed.
Options read_again(const Options& options) {
    if (options.arguments.empty()) return options;
    std::variant<Command, std::string> wanted = read_command(options.arguments);
    return std::get<Command>(std::move(wanted)).options;
}

}  // namespace

void watch_loop(const std::vector<std::string>& first, const Watching& watching) {
    watching.look_at(first);
    for (std::string why;;) {
        const std::vector<std::string> files = watching.build(why);
        if (watching.over()) return;
        watching.look_at(files);
        std::optional<std::string> change;
        while (!change) {
            change = watching.wait(std::nullopt);
            if (watching.over()) return;
        }
        why = *change;
        for (int i = 0; i < kMostQuietWaits && watching.wait(watching.quiet); ++i) {
        }
        if (watching.over()) return;
    }
}

void check_watchable(const Options& options, const std::string& who) {
    for (const std::string& name : options.inputs.names) {
        struct stat status {};
        const bool once =
            ::stat(name.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
        if (name != "-" && !once) continue;
        throw UsageError(
            fmt::format("{}, and {} can be read only once", who, name == "-" ? "standard input" : name),
            {"name a file"});
    }
}

void tell_build(const Options& options, const Build& done) {
    tell_printed(options, done.run);
    const std::vector<FileFindings> findings = done.findings();
    const Diagnostics& run = done.run.compilation.run_diagnostics;
    // A file of diagnostics also has to become empty again.
    if (!options.messages.file.empty() || has_any(findings, run)) report(options.messages, findings, run);
}

void stop_watching() {
    g_over.store(true);
    wake_up();
}

void watch(const Options& options, const Watched& watched) {
    FileChanges changes;
    const int wake = stop_on_signals();
    std::vector<std::string> files = options.inputs.names;
    if (!options.build.profile_file.empty()) files.push_back(options.build.profile_file);
    files.insert(files.end(), options.settings_files.begin(), options.settings_files.end());
    add_config_places(options, files);
    bool first = true;
    using Time = std::filesystem::file_time_type;
    Time begun = Time::max();
    std::set<std::string> seen;
    std::set<std::string> missing;  // that the last build would have read
    std::optional<std::string> missed;
    Watching watching;
    watching.quiet = watched.quiet;
    watching.build = [&](const std::string& why) {
        const MayBreakOff may(watched.harmless);
        begun = Time::clock::now();
        if (first) {
            first = false;
            return files = build_and_tell(options, watched, why, missing);
        }
        try {
            files = build_and_tell(read_again(options), watched, why, missing);
        } catch (const UsageError& error) {
            // Of a configuration that is being edited, say. What was looked at stays looked at.
            report_usage(error);
            if (watched.refused) watched.refused(error);
        }
        return files;
    };
    watching.look_at = [&](const std::vector<std::string>& names) {
        changes.look_at(names);
        for (const std::string& name : names) {
            const bool fresh = seen.insert(name).second && begun != Time::max();
            std::error_code error;
            if (missing.contains(name) ? std::filesystem::exists(name, error)
                                       : fresh && changed_since(name, begun)) {
                missed = name;
            }
        }
    };
    watching.wait = [&](std::optional<std::chrono::milliseconds> longest) {
        if (missed) return std::exchange(missed, std::nullopt);
        return changes.wait(wake, longest);
    };
    watching.over = [] { return g_over.load(); };
    watch_loop(files, watching);
}

int run_watch(const Options& options) {
    refuse_streams(options);
    Watched watched;
    watched.build = [](const Options& now, const std::string& why) {
        refuse_streams(now);
        const Build done = build(now);
        say(now.messages, line_of(done, why));
        tell_build(now, done);
        return BuiltOf{done.inputs, done.missing};
    };
    watch(options, watched);
    return exit_done;
}

}  // namespace popup::cli
