// Building again whenever an input changes.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/options.h"

namespace popup::cli {

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
};

// How long nothing must have changed before a build begins, and how long a build waits for that at most.
inline constexpr std::chrono::milliseconds kQuietTime{50};
inline constexpr int kMostQuietWaits = 40;

// Looks at `first` and builds, then builds once after each burst of changes, until it is over. Changes during
// a build lead to one more.
void watch_loop(const std::vector<std::string>& first, const Watching& watching);

// `popupc build --watch`: until SIGINT or SIGTERM, which let a build that is going on come to its end and
// give exit_done; a second one ends the program at once, without litter. Findings do not end it. UsageError
// where standard input or output is used, when an input can be read only once, and at the first reading of
// options that are wrong.
int run_watch(const Options& options);

}  // namespace popup::cli
