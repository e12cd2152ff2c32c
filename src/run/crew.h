// Threads that share a row of pieces of work, as many as there are allowed to be while it lasts.
#pragma once

#include <cstddef>
#include <functional>

namespace popup {

struct CrewOptions {
    std::size_t most = 1;                  // threads, the caller's among them; ≥ 1
    std::function<bool()> may_start = {};  // asked before each thread beside the caller's; empty: yes
    std::function<void()> ended =
        {};  // after each yes, once, when that thread has no more work; may be empty
    // Told how many pieces are done: by one thread at a time, in ascending order, not of each where they are
    // done faster than it returns, and at the end, by the caller's thread, that all are. May be empty.
    std::function<void(std::size_t done, std::size_t total)> progress = {};
};

// Calls work(0) to work(count - 1), each once, in the caller's thread and in others beside it. Whoever takes
// a piece while others are left asks for one more thread. Returns when all is done. What `work` throws comes
// through when all threads have ended; pieces that were not begun by then are left.
void share_work(std::size_t count, const CrewOptions& options, const std::function<void(std::size_t)>& work);

}  // namespace popup
