#include "base/in_parallel.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace popup {

void in_parallel(std::size_t count, int threads,
                 const std::function<void(std::size_t, std::size_t)>& progress,
                 const std::function<void(std::size_t)>& work) {
    std::atomic<std::size_t> next{0};
    std::atomic<std::size_t> done{0};
    std::mutex telling;
    // Each thread takes the next number that nobody has begun.
    const auto take_turns = [&] {
        for (std::size_t i = next++; i < count; i = next++) {
            work(i);
            ++done;
            if (!progress) continue;
            // Nobody waits for somebody else who is telling.
            const std::unique_lock lock(telling, std::try_to_lock);
            if (!lock) continue;
            const std::size_t now = done;
            if (now < count) progress(now, count);
        }
    };
    {
        const std::size_t wanted = std::min(static_cast<std::size_t>(std::max(threads, 1)), count);
        std::vector<std::jthread> others;
        try {
            for (std::size_t i = 1; i < wanted; ++i) others.emplace_back(take_turns);
        } catch (const std::system_error&) {
            // The system gives no more threads; those there are do the work.
        }
        take_turns();
    }
    if (progress && count > 0) progress(count, count);
}

}  // namespace popup
