// What fillers promise: they move pieces of one sheet to others, and what they find goes together.
#include "nest/fill.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "nest/construct.h"
#include "support/nest_check.h"
#include "support/nest_instances.h"

namespace popup {
namespace {

constexpr int kFillers = 2;

// A plan of those items alone that do not lie on `without`, and their job.
std::pair<NestJob, NestPlan> plan_without(const NestTask& task, const Arrangement& layout, int without) {
    NestJob job = task.job;
    job.items.clear();
    NestPlan plan;
    plan.sheets = layout.rows;
    plan.used.resize(layout.rows.size());
    for (int item = 0; item < static_cast<int>(layout.stands.size()); ++item) {
        const Stand& stand = nth(layout.stands, item);
        if (stand.sheet == without) continue;
        const TurnedShape& shape = nth(task.set.shapes, stand.shape);
        const auto x = static_cast<GridLength>(stand.x);
        const auto y = static_cast<GridLength>(stand.y);
        job.items.push_back(nth(task.job.items, item));
        plan.spots.push_back({stand.sheet, {from_grid(x), from_grid(y)}, shape.angle});
        Vec2& used = nth(plan.used, stand.sheet);
        used.x = std::max(used.x, from_grid(x + shape.bounds.x1));
        used.y = std::max(used.y, from_grid(y + shape.bounds.y1));
    }
    // No sheet of a plan is empty at its end.
    if (without + 1 == static_cast<int>(plan.sheets.size())) {
        plan.sheets.pop_back();
        plan.used.pop_back();
    }
    return {std::move(job), std::move(plan)};
}

double area_on(const NestTask& task, const Arrangement& layout, int sheet) {
    double sum = 0.0;
    for (std::size_t i = 0; i < layout.stands.size(); ++i) {
        if (layout.stands[i].sheet == sheet) sum += nth(task.set.areas, task.kinds[i]);
    }
    return sum;
}

bool same(const Stand& a, const Stand& b) {
    return a.sheet == b.sheet && a.shape == b.shape && a.x == b.x && a.y == b.y;
}

// Fills the sheets of a first layout, looks whether all that is promised holds, and gives the share of the
// area of the emptiest sheet that has left it.
double fill(const NestJob& job, double work, std::uint64_t seed) {
    NestTask task(job);
    Dice dice(seed);
    const Arrangement before = construct(task, dice, 12, 0.0).arrangement;
    const std::vector<int> victims = emptiest_sheets(task, before);
    EXPECT_GE(before.rows.size(), 3U);
    EXPECT_FALSE(victims.empty());
    if (victims.empty()) return 0.0;
    const int victim = victims.front();

    Arrangement after = before;
    bool moved = false;
    for (int i = 0; i < kFillers; ++i) {
        Filler filler(task, seed + static_cast<std::uint64_t>(i));
        filler.begin(before, victim, i, kFillers);
        filler.run(work);
        filler.put_into(after);
        moved = moved || filler.moved();
    }
    EXPECT_EQ(after.rows, before.rows);
    for (int item = 0; item < static_cast<int>(task.kinds.size()); ++item) {
        const Stand& was = nth(before.stands, item);
        const Stand& is = nth(after.stands, item);
        const bool stays = was.sheet == victim && is.sheet == victim;
        EXPECT_TRUE(!stays || same(was, is)) << item;
        EXPECT_TRUE(!task.is_locked(item) || same(was, is)) << item;
    }
    EXPECT_EQ(moved,
              std::mismatch(before.stands.begin(), before.stands.end(), after.stands.begin(), same).first !=
                  before.stands.end());
    if (test::nest_check_available()) {
        const auto [rest, plan] = plan_without(task, after, victim);
        EXPECT_EQ(test::nest_faults(rest, plan), std::vector<std::string>{});
    }
    const double least = area_on(task, before, victim);
    return (least - area_on(task, after, victim)) / least;
}

NestJob without_groups(int items, std::uint64_t seed) { return test::large_nest_instance(items, seed).job; }

TEST(Filler, MovesPiecesOfTheEmptiestSheetToTheOthers) {
    for (const std::uint64_t seed : {1U, 2U})
        EXPECT_GT(fill(without_groups(150, seed), 6e6, seed), 0.02) << seed;
}

TEST(Filler, KeepsGroupsTogetherAndKindsOfOneTurnInIt) {
    NestJob job = without_groups(150, 4);
    // Lots of three, of those of a size; every third kind has one turn.
    for (std::size_t i = 0; i < job.items.size(); ++i)
        job.items[i].group = i % 2 == 0 ? static_cast<int>(i / 6) : -1;
    for (std::size_t k = 0; k < job.kinds.size(); k += 3) job.kinds[k].one_turn = true;
    EXPECT_GT(fill(job, 1e7, 4), 0.0);
}

TEST(Filler, LeavesLockedPiecesWhereTheyAre) {
    NestJob job = without_groups(150, 5);
    job.items[0].locked = NestSpot{0, {20.0, 30.0}, {}};
    job.items[7].locked = NestSpot{1, {200.0, 100.0}, {}};
    EXPECT_GT(fill(job, 6e6, 5), 0.0);
}

// Without spacing pieces may touch exactly, which the table with room for rounding does not allow.
TEST(Filler, MayLetPiecesTouch) {
    NestJob job;
    for (const double width : {20.0, 30.0, 50.0}) {
        job.kinds.push_back(
            {{{{{0, 0}, {width, 0}, {width, 25}, {0, 25}}, {}}}, {Angle{}, Angle::degrees(90)}});
    }
    job.stock = {{100, 100, -1}};
    for (int i = 0; i < 61; ++i) job.items.push_back({i % 3, -1, {}});
    fill(job, 2e6, 6);
    NestEffort effort;
    effort.work = 1e5;
    const NestResult result = nest(job, effort);
    ASSERT_TRUE(result.plan);
    if (test::nest_check_available()) {
        EXPECT_EQ(test::nest_faults(job, *result.plan), std::vector<std::string>{});
    }
}

// The last piece of a sheet, and a gap that it fits exactly.
TEST(Filler, FillsTheLastGap) {
    NestJob job;
    const double side = 100.0 / 7.0;
    job.kinds = {{{{{{0, 0}, {side, 0}, {side, side}, {0, side}}, {}}}, {Angle{}}}};
    job.stock = {{7 * side, 7 * side, -1}};
    job.items.resize(49);
    NestTask task(job);
    const double step = static_cast<double>(task.set.shapes.front().bounds.width());
    Arrangement layout;
    layout.rows = {0, 0, 0};
    for (int item = 0; item < 49; ++item) layout.stands.push_back({0, 0, item % 7 * step, item / 7 * step});
    layout.stands[17] = {1, 0, 0, 0};
    layout.stands[30] = {2, 0, 0, 0};
    Filler filler(task, 1);
    filler.begin(layout, 1, 0, 1);
    filler.run(1e7);
    EXPECT_TRUE(filler.done());
    EXPECT_TRUE(filler.moved());
    filler.put_into(layout);
    EXPECT_NE(layout.stands[17].sheet, 1);
    EXPECT_TRUE(layout.holds(task));
}

// A stock of a sheet less than the first layout takes.
TEST(Filler, BringsInWhatTheFirstLayoutLeftOut) {
    NestJob job = without_groups(400, 1);
    NestEffort effort;
    effort.work = 1.0;
    effort.shortening = 0.0;
    const std::size_t sheets = nest(job, effort).plan->sheets.size();
    effort.work = 3e5;
    job.stock[0].count = static_cast<int>(sheets) - 1;
    const NestResult result = nest(job, effort);
    ASSERT_TRUE(result.plan);
    EXPECT_LT(result.plan->sheets.size(), sheets);
    if (test::nest_check_available()) {
        EXPECT_EQ(test::nest_faults(job, *result.plan), std::vector<std::string>{});
    }
}

TEST(Filler, FindsTheSameOnOneThreadAndOnTwo) {
    const NestJob job = without_groups(150, 7);
    NestEffort effort;
    effort.work = 3e5;
    effort.shortening = 0.0;
    const NestResult one = nest(job, effort);
    effort.threads = 2;
    const NestResult two = nest(job, effort);
    ASSERT_TRUE(one.plan && two.plan);
    EXPECT_EQ(one.plan->spots, two.plan->spots);
}

}  // namespace
}  // namespace popup
