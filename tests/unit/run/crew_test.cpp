// Threads that share work, and who is asked before they are started.
#include "run/crew.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "popup/compile.h"
#include "support/run_program.h"

namespace popup {
namespace {

TEST(Crew, DoesEachPieceOnce) {
    for (const std::size_t most : {1U, 2U, 7U, 40U}) {
        std::vector<std::atomic<int>> done(500);
        share_work(done.size(), {most, {}, {}}, [&](std::size_t i) { ++done[i]; });
        for (const std::atomic<int>& one : done) EXPECT_EQ(one, 1);
    }
    share_work(0, {4, {}, {}}, [](std::size_t) { FAIL(); });
}

TEST(Crew, NeverHasMoreThreadsThanItMay) {
    std::atomic<int> tokens{3};
    std::atomic<int> working{0};
    std::atomic<int> most{0};
    std::atomic<int> yes{0};
    std::atomic<int> ended{0};
    const CrewOptions options{100,
                              [&] {
                                  if (tokens.fetch_sub(1) <= 0) {
                                      ++tokens;
                                      return false;
                                  }
                                  ++yes;
                                  return true;
                              },
                              [&] {
                                  ++tokens;
                                  ++ended;
                              }};
    share_work(2000, options, [&](std::size_t) {
        const int now = ++working;
        for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) {
        }
        --working;
    });
    EXPECT_LE(most, 4);
    EXPECT_EQ(yes, ended);
    EXPECT_EQ(tokens, 3);
}

TEST(Crew, AsksForNoThreadThatWouldHaveNothingToDo) {
    int asked = 0;
    const auto ask = [&] {
        ++asked;
        return false;
    };
    share_work(1, {8, ask, {}}, [](std::size_t) {});
    EXPECT_EQ(asked, 0);
    share_work(5, {8, ask, {}}, [](std::size_t) {});
    EXPECT_EQ(asked, 4) << "again before each piece but the last";
    share_work(5, {1, ask, {}}, [](std::size_t) {});
    EXPECT_EQ(asked, 4);
}

TEST(Crew, WhatAThreadThrowsComesThroughAfterAllHaveEnded) {
    const auto here = std::this_thread::get_id();
    for (const bool own : {true, false}) {
        std::atomic<int> yes{0};
        std::atomic<int> ended{0};
        std::atomic<bool> has_thrown{false};
        const CrewOptions options{4,
                                  [&] {
                                      ++yes;
                                      return true;
                                  },
                                  [&] { ++ended; }};
        EXPECT_THROW(share_work(1000, options,
                                [&](std::size_t) {
                                    if ((std::this_thread::get_id() == here) == own) {
                                        has_thrown = true;
                                        throw std::runtime_error("no");
                                    }
                                    // Else this one might do it all.
                                    while (!own && !has_thrown) std::this_thread::yield();
                                }),
                     std::runtime_error)
            << own;
        EXPECT_EQ(yes, ended);
    }
}

TEST(Crew, ACompilationGivesBackEveryThreadItGot) {
    std::vector<Source> sources;
    for (int i = 0; i < 6; ++i) {
        const std::string path = std::string(POPUP_SOURCE_DIR) + "/samples/bird.xml";
        sources.push_back({path, test::read_file(path)});
    }
    std::atomic<int> yes{0};
    std::atomic<int> ended{0};
    CompileOptions options;
    options.threads = 16;
    options.may_start_thread = [&] {
        ++yes;
        return true;
    };
    options.thread_ended = [&] { ++ended; };
    const Compilation done = compile(std::move(sources), options, {});
    EXPECT_FALSE(done.has_errors());
    EXPECT_EQ(yes, ended);
    EXPECT_GE(yes, 2) << "for the designs, and one more for the search";
}

}  // namespace
}  // namespace popup
