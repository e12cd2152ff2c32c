#include "run/crew.h"

#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace popup {
namespace {

class Crew {
 public:
    Crew(std::size_t count, const CrewOptions& options, const std::function<void(std::size_t)>& work)
        : count_(count), options_(options), work_(work) {}
    Crew(const Crew&) = delete;
    Crew& operator=(const Crew&) = delete;

    ~Crew() { join(); }

    // Threads may start others until each of them has found that nothing is left.
    void join() {
        next_.store(count_);
        for (;;) {
            std::thread other;
            {
                const std::lock_guard lock(growing_);
                if (others_.empty()) return;
                other = std::move(others_.back());
                others_.pop_back();
            }
            other.join();
        }
    }

    void work() {
        for (std::size_t i = next_++; i < count_; i = next_++) {
            grow();
            work_(i);
            ++done_;
            tell();
        }
    }

    // Waits until all threads have ended, and throws what another than the caller's has thrown first.
    void finish() {
        join();
        if (thrown_) std::rethrow_exception(thrown_);
    }

 private:
    void grow() {
        const std::lock_guard lock(growing_);
        if (next_.load() >= count_ || begun_ >= options_.most) return;
        if (options_.may_start && !options_.may_start()) return;
        try {
            others_.emplace_back([this] {
                try {
                    work();
                } catch (...) {
                    const std::lock_guard of_thrown(growing_);
                    if (!thrown_) thrown_ = std::current_exception();
                    next_.store(count_);
                }
                if (options_.ended) options_.ended();
            });
            ++begun_;
        } catch (const std::system_error&) {
            // The system gives no more threads; those there are do the work.
            begun_ = options_.most;
            if (options_.ended) options_.ended();
        }
    }

    void tell() {
        if (!options_.progress) return;
        // Nobody waits for somebody else who is telling.
        const std::unique_lock lock(telling_, std::try_to_lock);
        if (!lock) return;
        const std::size_t now = done_;
        if (now < count_) options_.progress(now, count_);
    }

    const std::size_t count_;
    const CrewOptions& options_;
    const std::function<void(std::size_t)>& work_;
    std::atomic<std::size_t> next_{0};
    std::atomic<std::size_t> done_{0};
    std::mutex telling_;
    std::mutex growing_;
    std::size_t begun_ = 1;
    std::vector<std::thread> others_;
    std::exception_ptr thrown_;  // the first, of another thread than the caller's
};

}  // namespace

void share_work(std::size_t count, const CrewOptions& options, const std::function<void(std::size_t)>& work) {
    {
        Crew crew(count, options, work);
        crew.work();
        crew.finish();
    }
    if (options.progress && count > 0) options.progress(count, count);
}

}  // namespace popup
