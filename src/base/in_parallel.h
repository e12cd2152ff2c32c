// Many pieces of work that share nothing, done by several threads.
#pragma once

#include <cstddef>
#include <functional>

namespace popup {

// Calls work(0) to work(count - 1), each once, from this thread and up to `threads` - 1 others, and returns
// when all are done. `work` must not throw. `progress`, which may be empty, is told how many are done: by one
// thread at a time, in ascending order, not of each where they are done faster than it returns, and at the
// end, by this thread, that all are.
void in_parallel(std::size_t count, int threads,
                 const std::function<void(std::size_t done, std::size_t total)>& progress,
                 const std::function<void(std::size_t)>& work);

}  // namespace popup
