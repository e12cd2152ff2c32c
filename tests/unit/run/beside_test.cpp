// Work beside other work: done once, by whoever comes first, and never lost.
#include "run/beside.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

namespace popup {
namespace {

class BesideThreads : public testing::TestWithParam<bool> {};

TEST_P(BesideThreads, DoTheWorkOnce) {
    for (int i = 0; i < 300; ++i) {
        std::atomic<int> calls{0};
        Beside<std::string> work(
            [&calls] {
                ++calls;
                return std::string(1000, 'x');
            },
            GetParam());
        if (i % 2 == 0) std::this_thread::yield();
        EXPECT_EQ(work.get(), std::string(1000, 'x'));
        EXPECT_EQ(calls, 1);
    }
}

TEST_P(BesideThreads, MayBeTakenOnce) {
    Beside<std::optional<int>> work([] { return std::optional(7); }, GetParam());
    EXPECT_EQ(work.take(), 7);
    EXPECT_EQ(work.take(), std::nullopt);
}

TEST_P(BesideThreads, HandOnWhatIsThrown) {
    Beside<int> work([]() -> int { throw std::runtime_error("no memory"); }, GetParam());
    EXPECT_THROW(work.get(), std::runtime_error);
}

TEST_P(BesideThreads, TouchNothingOnceNobodyAsks) {
    for (int i = 0; i < 300; ++i) {
        // What the work writes to is gone after this turn.
        const auto place = std::make_unique<std::string>();
        const Beside<int> work(
            [at = place.get()] {
                at->assign(1000, 'x');
                return 0;
            },
            GetParam());
        if (i % 2 == 0) std::this_thread::yield();
    }
}

INSTANTIATE_TEST_SUITE_P(Beside, BesideThreads, testing::Bool(),
                         [](const auto& one) { return one.param ? "OfTheirOwn" : "OfTheCaller"; });

TEST(BesideThread, WorksWhileItsCallerDoes) {
    // The caller waits for the thread, which therefore must have run beside it.
    std::atomic<bool> begun{false};
    Beside<std::thread::id> work(
        [&begun] {
            begun = true;
            return std::this_thread::get_id();
        },
        true);
    while (!begun) std::this_thread::yield();
    EXPECT_NE(work.get(), std::this_thread::get_id());
}

}  // namespace
}  // namespace popup
