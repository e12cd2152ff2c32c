// What no layout can do better than.
#include "nest/bounds.h"

#include <gtest/gtest.h>

#include "popup/nest.h"

namespace popup {
namespace {

NestKind rectangle(double width, double height, std::vector<Angle> turns = {{}}) {
    NestKind kind;
    Polygon polygon;
    polygon.outer = {{0, 0}, {width, 0}, {width, height}, {0, height}};
    kind.outline = {polygon};
    kind.turns = std::move(turns);
    return kind;
}

NestJob job_of(std::vector<NestKind> kinds, double width, double height) {
    NestJob job;
    job.kinds = std::move(kinds);
    for (int k = 0; k < static_cast<int>(job.kinds.size()); ++k) job.items.push_back({k, -1, {}});
    job.stock = {{width, height, -1}};
    return job;
}

// A page of 100 x 80 takes a sheet of 110 x 90 but for 10 on two sides: what is wider goes to the other.
NestJob page_and_pieces() {
    return job_of({rectangle(100, 80), rectangle(60, 45), rectangle(12, 40), rectangle(8, 40)}, 110, 90);
}

Arrangement in_a_row(const NestTask& task) {
    Arrangement layout;
    layout.rows = {0, 0};
    for (int item = 0; item < static_cast<int>(task.kinds.size()); ++item)
        layout.stands.push_back({item == 0 ? 0 : 1, task.set.of_kind[index(item)].front(), 0.0, 0.0});
    layout.stands[2].x = 65.0 * kGridSteps;
    return layout;
}

TEST(NestBounds, WhatFitsBesideNoPageLiesOnTheLastSheet) {
    const NestJob job = page_and_pieces();
    NestTask task(job);
    const Arrangement layout = in_a_row(task);
    EXPECT_TRUE(must_part(task, 0, 1));
    EXPECT_TRUE(must_part(task, 0, 2));
    EXPECT_FALSE(must_part(task, 0, 3)) << "8 fit beside the page";
    EXPECT_FALSE(must_part(task, 1, 2));
    EXPECT_EQ(known_last(task, layout), (std::vector<char>{0, 1, 1, 0}));
    EXPECT_FALSE(could_be_fewer(task, layout));
    EXPECT_DOUBLE_EQ(least_length(task, layout.rows, known_last(task, layout)), 60.0 * kGridSteps);
    EXPECT_LT(least_length(task, layout.rows, {}), 60.0 * kGridSteps);
}

TEST(NestBounds, NothingIsKnownWhereThePageMayLieOnTheLastSheet) {
    const NestJob job = page_and_pieces();
    NestTask task(job);
    Arrangement layout = in_a_row(task);
    layout.stands[1].x = 45.0 * kGridSteps;  // 105 long: a layout with the page there would be shorter
    EXPECT_EQ(known_last(task, layout), (std::vector<char>{0, 0, 0, 0}));
}

// The two halves of a square cut askew fill a sheet of its size, and touch all along the cut.
TEST(NestBounds, WhatSharesASheetOnlyWithoutAGapNeedNotPart) {
    NestJob job = job_of({rectangle(1, 1), rectangle(1, 1)}, 100, 100);
    job.kinds[0].outline[0].outer = {{0, 0}, {60, 0}, {30, 100}, {0, 100}};
    job.kinds[1].outline[0].outer = {{60, 0}, {100, 0}, {100, 100}, {30, 100}};
    NestTask task(job);
    EXPECT_FALSE(must_part(task, 0, 1));
    job.stock[0].width = 99.99;
    NestTask smaller(job);
    EXPECT_TRUE(must_part(smaller, 0, 1));
}

TEST(NestBounds, NothingIsKnownWhereItemsAreLocked) {
    NestJob job = page_and_pieces();
    job.items[0].locked = NestSpot{0, {0, 0}, {}};
    NestTask task(job);
    EXPECT_EQ(known_last(task, in_a_row(task)), (std::vector<char>{0, 0, 0, 0}));
}

// Two of 45 x 60 are on the last sheet, which is 90 high: its length is 60 at the least by their area.
TEST(NestBounds, AreaOnTheLastSheetBoundsItToo) {
    const NestJob job = job_of({rectangle(100, 80), rectangle(45, 60), rectangle(45, 60)}, 110, 90);
    NestTask task(job);
    Arrangement layout = in_a_row(task);
    layout.stands[2].x = 50.0 * kGridSteps;
    EXPECT_DOUBLE_EQ(least_length(task, layout.rows, known_last(task, layout)), 60.0 * kGridSteps)
        << "5400 mm2 on 90 mm";
}

TEST(NestBounds, AHastySearchEndsAtTheShortestThereCanBe) {
    const NestJob job = page_and_pieces();
    NestEffort effort;
    effort.shortening = 1e5;
    int looks = 0;
    effort.progress = [&](const NestProgress&) { ++looks; };
    const NestResult result = nest(job, effort);
    ASSERT_TRUE(result.plan);
    ASSERT_EQ(result.plan->sheets.size(), 2U);
    EXPECT_DOUBLE_EQ(result.plan->used[1].x, 60.0);
    EXPECT_LE(looks, 4) << "no search for what there cannot be";
}

}  // namespace
}  // namespace popup
