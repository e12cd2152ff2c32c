// Building again whenever an input changes.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/options.h"

namespace popup::cli {

struct Build;

// What the loop needs to know of the world.
struct Watching {
    // Builds; `why` is the file that changed, empty the first time. Gives the files to look at from now on.
    std::function<std::vector<std::string>(const std::string& why)> build;
    // From now on these files matter.
    std::function<void(const std::vector<std::string>&)> look_at;
    // Waits, at most so long, for a change, and gives the file; nullopt when there was none, or it is over.
    std::function<std::optional<std::string>(std::optional<std::chrono::milliseconds>)> wait;
    // Whether to stop; asked after every wait and every build.
    std::function<bool()> over;
    // How long nothing must have changed before a build begins.
    std::chrono::milliseconds quiet{50};
};

// How many quiet times a build waits at most.
inline constexpr int kMostQuietWaits = 40;

// Looks at `first` and builds, then builds once after each burst of changes, until it is over. Changes during
// a build lead to one more.
void watch_loop(const std::vector<std::string>& first, const Watching& watching);

// What a build has read, and would have read.
struct BuiltOf {
    std::vector<std::string> inputs;   // as in Build
    std::vector<std::string> missing;  // likewise
};

// What is built again whenever a file changes that it was built of.
struct Watched {
    // Builds with the options as they are now, and tells of it; `why` is the file that changed, empty the
    // first time. UsageError where the options are wrong.
    std::function<BuiltOf(const Options&, const std::string& why)> build;
    // Options that were read again are wrong. Called after it was told on standard error.
    std::function<void(const UsageError&)> refused = {};
    std::chrono::milliseconds quiet = Watching().quiet;
    // A build may be broken off: it writes nothing.
    bool harmless = false;
};

// Builds at once and after each change, until SIGINT, SIGTERM or stop_watching(); then the build that is
// going on comes to its end, or, if it is harmless, ends the program with exit_done. A second signal ends the
// program at once, without litter. What the first build throws goes to the caller; wrong options that are
// read again, from a configuration that has changed, are told on standard error.
void watch(const Options& options, const Watched& watched);

// Ends watch(). From any thread.
void stop_watching();

// UsageError when an input can be read only once; `who` "builds again and again".
void check_watchable(const Options& options, const std::string& who);

// Tells what programs have printed, and all findings where there are any.
void tell_build(const Options& options, const Build& done);

// `popupc build --watch`. Findings do not end it. UsageError where standard input or output is used, when an
// input can be read only once, and at the first reading of options that are wrong.
int run_watch(const Options& options);

}  // namespace popup::cli
