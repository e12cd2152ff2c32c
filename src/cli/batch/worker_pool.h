// Jobs done by processes of their own, so that one that dies takes no other with it, and memory stays flat
// however many there are.
#pragma once

#include <csignal>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>

namespace popup::cli {

// How a job ended.
struct JobEnd {
    std::size_t job = 0;
    std::optional<std::string> reply;  // what `work` gave; nothing: the process died of it, twice
    int signal = 0;                    // by which it died; 0: it ended itself
};

struct PoolOptions {
    std::size_t workers = 1;            // at most; at least 1
    std::size_t jobs_per_worker = 256;  // then a new process takes over
    // Asked before each worker but the first begins on a job while none of its kind runs; may be empty.
    std::function<bool()> may_start;
    std::function<void()> stopped;  // one of those that may_start() allowed has nothing to do any more
    std::function<void()> begun;    // called first in each process; may be empty
    int wake_on = -1;               // a descriptor that becomes readable when may_start() may say yes again
};

// Does `work` for each job in processes forked from this one, which must have a single thread, and calls
// `ended` here for each, in the order they end; when it returns false, no further job is begun. A job whose
// process dies is tried once more. `work` runs with standard input empty. Workers end when this process does.
//
// The first SIGINT, SIGTERM or SIGHUP lets the running jobs end and begins no other; the second stops those
// as well. Returns the signal, or 0. Afterwards signals are handled as before.
int run_pool(std::span<const std::size_t> jobs, const PoolOptions& options,
             const std::function<std::string(std::size_t)>& work,
             const std::function<bool(const JobEnd&)>& ended);

}  // namespace popup::cli
