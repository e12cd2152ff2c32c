// Work that another thread does meanwhile, if it comes to it in time.
#pragma once

#include <atomic>
#include <future>
#include <memory>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

namespace popup {

// Calls work() once: in a thread of its own, or in get() where that thread has not begun by then. So a busy
// machine makes nobody wait for a thread that waits itself.
//
//     Beside<std::string> picture([&model] { return drawn(model); }, threads > 1);
//     const std::string rest = write_rest();
//     return rest + picture.get();
//
// Where get() is not called, the destructor waits for work that has begun, and work that has not is never
// done: `work` may refer to what outlives this object.
template <typename Result>
class Beside {
 public:
    // `in_thread`: false leaves all to get(), and so it is where the system gives no more threads.
    template <typename Work>
    Beside(Work work, bool in_thread) : shared_(std::make_shared<Shared>(std::move(work))) {
        if (!in_thread) return;
        try {
            // It may come to its turn when all is over, and then it looks at nothing but what it shares.
            std::thread([shared = shared_] { shared->run(); }).detach();
        } catch (const std::system_error&) {
        }
    }
    Beside(const Beside&) = delete;
    Beside& operator=(const Beside&) = delete;
    ~Beside() {
        if (shared_->taken.exchange(true) && made_.valid()) made_.wait();
    }

    // What work() gave, or what it threw. To be called once.
    Result get() {
        shared_->run();
        return made_.get();
    }
    // Of an optional: get() the first time, and nullopt from then on.
    Result take() {
        if (std::exchange(was_taken_, true)) return std::nullopt;
        return get();
    }

 private:
    struct Shared {
        template <typename Work>
        explicit Shared(Work work) : task(std::move(work)) {}
        void run() {
            if (!taken.exchange(true)) task();
        }
        std::atomic<bool> taken{false};
        std::packaged_task<Result()> task;
    };

    std::shared_ptr<Shared> shared_;
    std::future<Result> made_ = shared_->task.get_future();
    bool was_taken_ = false;
};

}  // namespace popup
