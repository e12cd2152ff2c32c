// What nest() promises, over generated jobs, judged by a checker that shares nothing with the search.
#include "popup/nest.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <random>
#include <tuple>

#include "nest/convex_parts.h"
#include "nest/exact.h"
#include "nest/no_fit.h"
#include "support/nest_check.h"
#include "support/nest_instances.h"

namespace popup {
namespace {

using test::nest_faults;

double number(std::mt19937& random, double low, double high) {
    return low + (high - low) * (static_cast<double>(random()) / 4294967295.0);
}

Ring rectangle(double width, double height, Vec2 at = {}) {
    return {at, at + Vec2{width, 0}, at + Vec2{width, height}, at + Vec2{0, height}};
}

// A star with dents, about a place far from the origin; some with a hole.
Polygon random_outline(std::mt19937& random, double size, bool hole) {
    const int corners = 3 + static_cast<int>(random() % 9);
    const Vec2 middle{number(random, -300, 300), number(random, -300, 300)};
    Polygon polygon;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * (i + number(random, 0.0, 0.6)) / corners;
        const double radius = size * number(random, 0.35, 1.0);
        polygon.outer.push_back(middle + radius * Vec2{std::cos(angle), std::sin(angle)});
    }
    if (hole) {
        polygon.outer = rectangle(2 * size, 2 * size, middle - Vec2{size, size});
        const double in = 0.8 * size;
        polygon.holes = {
            {middle + Vec2{-in, -in}, middle + Vec2{-in, in}, middle + Vec2{in, in}, middle + Vec2{in, -in}}};
    }
    return polygon;
}

std::vector<Angle> turns(std::initializer_list<double> degrees) {
    std::vector<Angle> result;
    for (const double d : degrees) result.push_back(Angle::degrees(d));
    return result;
}

NestJob random_job(std::mt19937& random, int kinds) {
    NestJob job;
    for (int k = 0; k < kinds; ++k) {
        NestKind kind{{random_outline(random, number(random, 5, 40), k % 4 == 3)}, {}};
        switch (random() % 4) {
            case 0:
                kind.turns = turns({0});
                break;
            case 1:
                kind.turns = turns({0, 180});
                break;
            case 2:
                kind.turns = turns({0, 90, 180, 270});
                break;
            default:
                kind.turns = turns({0, 37.5, 123.4567891});
                break;
        }
        kind.one_turn = random() % 5 == 0;
        const int count = 1 + static_cast<int>(random() % 4);
        for (int i = 0; i < count; ++i) job.items.push_back({k, -1, {}});
        job.kinds.push_back(std::move(kind));
    }
    job.stock = {{240, 200, -1}};
    const std::array spacings{0.0, 0.5, 2.0, 3.1415926};
    job.spacing = spacings[random() % spacings.size()];
    job.use_holes = random() % 3 != 0;
    return job;
}

NestEffort little(std::uint64_t seed = 0) {
    NestEffort effort;
    effort.work = 2e4;
    effort.seed = seed;
    return effort;
}

void expect_sound(const NestJob& job, const NestResult& result) {
    ASSERT_TRUE(result.plan.has_value());
    EXPECT_FALSE(result.refusal.has_value());
    const auto faults = nest_faults(job, *result.plan);
    EXPECT_TRUE(faults.empty()) << faults.size() << " faults, the first: " << faults.front();
}

class Nest : public testing::Test {
 protected:
    void SetUp() override {
        if (!test::nest_check_available()) GTEST_SKIP() << test::kNestCheckMissing;
    }
};
class LongNest : public Nest {};

TEST_F(Nest, GeneratedJobsHaveNoOverlapAndKeepTheSpacing) {
    std::mt19937 random(1);
    for (int round = 0; round < 25; ++round) {
        const NestJob job = random_job(random, 2 + round % 9);
        expect_sound(job, nest(job, little(static_cast<std::uint64_t>(round))));
        if (HasFailure()) FAIL() << "round " << round;
    }
}

TEST_F(LongNest, ManyGeneratedJobsHaveNoOverlapAndKeepTheSpacing) {
    std::mt19937 random(2);
    for (int round = 0; round < 600; ++round) {
        const NestJob job = random_job(random, 2 + round % 14);
        NestEffort effort = little(static_cast<std::uint64_t>(round));
        effort.work = round % 7 == 0 ? 0.0 : 3e4;
        expect_sound(job, nest(job, effort));
        if (HasFailure()) FAIL() << "round " << round;
    }
}

TEST_F(Nest, GroupsLocksAndStocksAreKept) {
    std::mt19937 random(3);
    for (int round = 0; round < 12; ++round) {
        NestJob job = random_job(random, 6);
        for (std::size_t i = 0; i < job.items.size(); ++i) job.items[i].group = static_cast<int>(i / 3);
        if (round % 2 == 0) {
            // The first item stands in the corner of the second sheet of those that come largest first.
            const NestKind& kind = job.kinds[0];
            const Box box = bounds(kind.outline[0].outer);
            job.items[0].locked = NestSpot{1, Vec2{1.0, 2.0} - box.min, kind.turns[0]};
            // Stands on the grid, as all places do.
            Vec2& at = job.items[0].locked->offset;
            at = {std::ceil(at.x), std::ceil(at.y)};
        }
        job.stock = {{150, 120, 3}, {240, 200, -1}};
        expect_sound(job, nest(job, little()));
        if (HasFailure()) FAIL() << "round " << round;
    }
}

TEST_F(Nest, TheSameJobGivesTheSameLayoutWithAnyThreads) {
    std::mt19937 random(4);
    for (int round = 0; round < 4; ++round) {
        const NestJob job = random_job(random, 8);
        NestEffort effort = little(7);
        effort.work = 2e5;
        const NestResult one = nest(job, effort);
        for (const int threads : {2, 3, 8}) {
            effort.threads = threads;
            const NestResult other = nest(job, effort);
            ASSERT_TRUE(one.plan && other.plan);
            EXPECT_EQ(one.plan->spots, other.plan->spots) << threads;
            EXPECT_EQ(one.plan->sheets, other.plan->sheets);
        }
        effort.seed = 8;
        const NestResult seeded = nest(job, effort);
        ASSERT_TRUE(seeded.plan);
        EXPECT_NE(one.plan->spots, seeded.plan->spots) << "another seed looks elsewhere";
    }
}

TEST_F(Nest, MoreEffortIsNeverLongerOnAJobOfOneSheet) {
    std::mt19937 random(5);
    double little_sum = 0.0;
    double much_sum = 0.0;
    for (int round = 0; round < 4; ++round) {
        NestJob job = random_job(random, 7);
        job.stock = {{3000, 150, 1}};
        NestEffort effort = little();
        effort.work = 0.0;
        const NestResult none = nest(job, effort);
        effort.work = 1e6;
        const NestResult much = nest(job, effort);
        ASSERT_TRUE(none.plan && much.plan);
        little_sum += none.plan->used[0].x;
        much_sum += much.plan->used[0].x;
        EXPECT_LE(much.plan->used[0].x, none.plan->used[0].x + 1e-6);
    }
    EXPECT_LT(much_sum, 0.97 * little_sum) << "the search gains something";
}

TEST_F(Nest, HasteCostsNoSheet) {
    std::mt19937 random(12);
    for (int round = 0; round < 8; ++round) {
        NestJob job = random_job(random, 7);
        job.stock = {{120, 90, -1}};
        NestEffort effort;
        effort.work = 1e5;
        const NestResult patient = nest(job, effort);
        effort.shortening = 2e4;
        const NestResult hasty = nest(job, effort);
        expect_sound(job, hasty);
        EXPECT_LE(hasty.plan->sheets.size(), patient.plan->sheets.size()) << round;
    }
}

TEST(NestNoFit, WhatCoversABoxOverlapsAllOverIt) {
    std::mt19937 random(13);
    int covered = 0;
    for (int round = 0; round < 300; ++round) {
        NestJob job;
        for (int k = 0; k < 2; ++k) job.kinds.push_back({{random_outline(random, 30, k == 1)}, turns({0})});
        const ShapeSet set = make_shapes(job);
        if (!set.exact) continue;
        const ExactShapes exact(set.shapes);
        NoFit fit;
        make_no_fit(set.shapes[0], set.shapes[1], 0.0, fit);
        const double x = number(random, fit.x0, fit.x1);
        const double y = number(random, fit.y0, fit.y1);
        const double size = number(random, 1.0, 2e7);
        if (!covers(fit, {x, y, x + size, y + size})) continue;
        ++covered;
        for (int i = 0; i < 50; ++i) {
            const GridPoint at{std::llround(x + size * number(random, 0, 1)),
                               std::llround(y + size * number(random, 0, 1))};
            EXPECT_FALSE(exact.apart(0, at, 1, {}, 0));
        }
    }
    EXPECT_GT(covered, 40);
}

// A rectangle cut by slanted lines between whole points of its edges: pieces that fill it only without a gap.
TEST_F(Nest, JigsawsThatFitOnlyWithoutAGapAreSolved) {
    const std::vector<std::vector<Ring>> jigsaws{
        {{{0, 0}, {60, 0}, {30, 100}, {0, 100}}, {{60, 0}, {100, 0}, {100, 100}, {30, 100}}},
        {{{0, 0}, {70, 0}, {0, 40}},
         {{70, 0}, {100, 0}, {100, 100}, {60, 100}, {0, 40}},
         {{0, 40}, {60, 100}, {0, 100}}},
        {{{0, 0}, {33, 0}, {50, 55}, {0, 71}},
         {{33, 0}, {100, 0}, {100, 37}, {50, 55}},
         {{0, 71}, {50, 55}, {68, 100}, {0, 100}},
         {{50, 55}, {100, 37}, {100, 100}, {68, 100}}}};
    for (std::size_t j = 0; j < jigsaws.size(); ++j) {
        NestJob job;
        for (const Ring& ring : jigsaws[j]) {
            job.items.push_back({static_cast<int>(job.kinds.size()), -1, {}});
            job.kinds.push_back({{{ring, {}}}, turns({0})});
        }
        job.stock = {{100, 100, -1}};
        NestEffort effort;
        effort.work = 3e6;
        const NestResult result = nest(job, effort);
        expect_sound(job, result);
        EXPECT_EQ(result.plan->sheets.size(), 1U) << "jigsaw " << j;
    }
}

TEST_F(Nest, PiecesGoIntoHolesUnlessToldNotTo) {
    NestJob job;
    Polygon frame{rectangle(100, 100), {}};
    frame.holes = {{{10, 10}, {10, 90}, {90, 90}, {90, 10}}};
    job.kinds = {{{frame}, turns({0})}, {{{rectangle(76, 76), {}}}, turns({0})}};
    job.items = {{0, -1, {}}, {1, -1, {}}};
    job.stock = {{300, 100, -1}};
    job.spacing = 2.0;
    const NestResult in = nest(job, little());
    expect_sound(job, in);
    EXPECT_NEAR(in.plan->used[0].x, 100.0, 1e-6);
    job.use_holes = false;
    const NestResult beside = nest(job, little());
    expect_sound(job, beside);
    EXPECT_NEAR(beside.plan->used[0].x, 178.0, 1e-5);
}

TEST_F(Nest, AHoleThatNothingFitsIsStillPaperFree) {
    // The hole is too small for the other piece, so the search may take it for paper; the layout is the same.
    NestJob job;
    Polygon frame{rectangle(50, 50), {}};
    frame.holes = {{{20, 20}, {20, 30}, {30, 30}, {30, 20}}};
    job.kinds = {{{frame}, turns({0})}, {{{rectangle(30, 50), {}}}, turns({0})}};
    job.items = {{0, -1, {}}, {1, -1, {}}};
    job.stock = {{80, 50, 1}};
    expect_sound(job, nest(job, little()));
}

TEST_F(Nest, ThousandsOfPiecesArePlacedInBatches) {
    std::mt19937 random(6);
    NestJob job;
    for (int k = 0; k < 12; ++k)
        job.kinds.push_back({{random_outline(random, 12, false)}, turns({0, 180}), k % 3 == 0});
    for (int i = 0; i < 1700; ++i) job.items.push_back({i % 12, -1, {}});
    job.stock = {{500, 400, -1}};
    job.spacing = 1.0;
    NestEffort effort;
    effort.work = 1e3;
    expect_sound(job, nest(job, effort));
}

// How many sheets of a plan differ: in what kinds lie where.
std::size_t different_sheets(const NestJob& job, const NestPlan& plan) {
    std::vector<std::vector<std::array<double, 4>>> sheets(plan.sheets.size());
    for (std::size_t i = 0; i < plan.spots.size(); ++i) {
        const NestSpot& spot = plan.spots[i];
        sheets[static_cast<std::size_t>(spot.sheet)].push_back(
            {static_cast<double>(job.items[i].kind), spot.offset.x, spot.offset.y, spot.angle.deg});
    }
    for (auto& sheet : sheets) std::sort(sheet.begin(), sheet.end());
    std::sort(sheets.begin(), sheets.end());
    return static_cast<std::size_t>(std::unique(sheets.begin(), sheets.end()) - sheets.begin());
}

// Many copies: their sheets are those of a few, again and again, and all copies are there.
TEST_F(Nest, SheetsOfManyCopiesAreThoseOfAFewRepeated) {
    std::mt19937 random(14);
    for (const bool grouped : {false, true}) {
        NestJob job;
        for (int k = 0; k < 4; ++k)
            job.kinds.push_back({{random_outline(random, 30, k == 3)}, turns({0, 90}), k == 1});
        job.stock = {{240, 200, -1}};
        job.spacing = 1.0;
        const auto sheets_of = [&](int copies, std::size_t& different) {
            job.items.clear();
            for (int i = 0; i < 4 * copies; ++i) job.items.push_back({i % 4, grouped ? i / 4 : -1, {}});
            const NestResult result = nest(job, little());
            expect_sound(job, result);
            different = different_sheets(job, *result.plan);
            return result.plan->sheets.size();
        };
        std::size_t few = 0;
        std::size_t many = 0;
        const std::size_t sheets_of_few = sheets_of(12, few);
        const std::size_t sheets_of_many = sheets_of(600, many);
        EXPECT_LE(sheets_of_many, 51 * sheets_of_few);
        EXPECT_LE(many, 4 * few) << "of " << sheets_of_many;
    }
}

TEST_F(Nest, RepeatedSheetsAreNoMoreThanTheStockHas) {
    NestJob job;
    job.kinds = {{{{rectangle(60, 40), {}}}, turns({0, 90})}, {{{rectangle(30, 20), {}}}, turns({0, 90})}};
    job.stock = {{130, 90, 20}, {100, 90, -1}};
    for (int i = 0; i < 400; ++i) job.items.push_back({i % 2, -1, {}});
    const NestResult result = nest(job, little());
    expect_sound(job, result);
    const auto& sheets = result.plan->sheets;
    EXPECT_EQ(std::count(sheets.begin(), sheets.end(), 0), 20);
}

TEST_F(Nest, WhatStandsInTheWayIsNamed) {
    using Reason = NestRefusal::Reason;
    NestJob job;
    job.kinds = {{{{rectangle(60, 60), {}}}, turns({0})}, {{{rectangle(120, 10), {}}}, turns({0})}};
    job.stock = {{100, 100, -1}};
    job.items = {{0, -1, {}}, {1, -1, {}}};
    const auto refusal = [&] {
        const NestResult result = nest(job, little());
        EXPECT_FALSE(result.plan.has_value());
        EXPECT_TRUE(result.refusal.has_value());
        return result.refusal.value_or(NestRefusal{});
    };
    EXPECT_EQ(refusal().reason, Reason::too_large);
    EXPECT_EQ(refusal().items, std::vector<int>{1});

    job.items = {{0, -1, {}}, {0, -1, {}}, {0, -1, {}}};
    job.stock[0].count = 2;
    EXPECT_EQ(refusal().reason, Reason::stock_used_up);
    EXPECT_EQ(refusal().items.size(), 1U);

    job.stock[0].count = -1;
    job.items = {{0, 5, {}}, {0, 5, {}}};
    EXPECT_EQ(refusal().reason, Reason::group_too_large);

    job.items = {{0, -1, NestSpot{0, {41, 0}, {}}}};
    EXPECT_EQ(refusal().reason, Reason::lock_outside);
    job.items = {{0, -1, NestSpot{0, {0, 0}, Angle::degrees(90)}}};
    EXPECT_EQ(refusal().reason, Reason::lock_outside) << "a turn that is not allowed";
    job.items = {{0, -1, NestSpot{0, {0, 0}, {}}}, {0, -1, NestSpot{0, {30, 0}, {}}}};
    EXPECT_EQ(refusal().reason, Reason::lock_overlap);
    EXPECT_EQ(refusal().items, (std::vector<int>{0, 1}));
}

TEST_F(Nest, LocksThatContradictGroupsOrOneTurnAreNamed) {
    using Reason = NestRefusal::Reason;
    NestJob job;
    job.kinds = {{{{rectangle(20, 10), {}}}, turns({0, 180}), true}};
    job.stock = {{100, 100, -1}};
    const NestSpot here{0, {30, 30}, {}};
    const NestSpot turned{0, {80, 80}, Angle::degrees(180)};
    const NestSpot elsewhere{1, {30, 30}, {}};
    job.items = {{0, -1, here}, {0, -1, {}}, {0, -1, turned}};
    NestResult result = nest(job, little());
    ASSERT_TRUE(result.refusal.has_value());
    EXPECT_EQ(result.refusal->reason, Reason::lock_apart);
    EXPECT_EQ(result.refusal->items, (std::vector<int>{0, 2}));
    job.items = {{0, 4, here}, {0, 4, elsewhere}};
    result = nest(job, little());
    ASSERT_TRUE(result.refusal.has_value());
    EXPECT_EQ(result.refusal->reason, Reason::lock_apart);
    job.items = {{0, 4, here}, {0, 5, elsewhere}};
    expect_sound(job, nest(job, little()));
    job.items = {{0, -1, NestSpot{7, {0, 0}, {}}}};
    result = nest(job, little());
    ASSERT_TRUE(result.refusal.has_value());
    EXPECT_EQ(result.refusal->reason, Reason::lock_outside) << "no eighth sheet for one piece";
}

TEST_F(Nest, AGroupThatFitsNoSheetIsNotTakenForAStockUsedUp) {
    using Reason = NestRefusal::Reason;
    NestJob job;
    job.kinds = {{{{rectangle(60, 60), {}}}, turns({0})}};
    job.stock = {{100, 70, -1}};
    job.items = {{0, 1, {}}, {0, 1, {}}, {0, 2, {}}, {0, 2, {}}};
    EXPECT_EQ(nest(job, little()).refusal.value_or(NestRefusal{}).reason, Reason::group_too_large);
    job.stock = {{130, 70, 1}};
    EXPECT_EQ(nest(job, little()).refusal.value_or(NestRefusal{}).reason, Reason::stock_used_up);
}

// What lies on a smaller sheet of the stock must come back when it is locked where it lies.
TEST_F(Nest, ALayoutLockedAsItIsIsTheSameLayout) {
    std::mt19937 random(11);
    for (int round = 0; round < 6; ++round) {
        NestJob job = random_job(random, 5);
        job.stock = {{150, 120, 2}, {240, 200, -1}, {300, 90, -1}};
        const NestResult free = nest(job, little());
        expect_sound(job, free);
        for (std::size_t i = 0; i < job.items.size(); ++i) job.items[i].locked = free.plan->spots[i];
        const NestResult locked = nest(job, little());
        expect_sound(job, locked);
        EXPECT_EQ(locked.plan->spots, free.plan->spots);
        if (HasFailure()) FAIL() << "round " << round;
    }
}

TEST_F(Nest, SliversAndTheSmallestSpacingKeepTheirDistance) {
    for (const auto& [length, height, spacing] :
         {std::tuple{300.0, 0.001, 0.1}, std::tuple{200.0, 0.01, 0.01}, std::tuple{40000.0, 0.005, 2.0},
          std::tuple{100.0, 0.01, 0.000001}}) {
        NestJob job;
        job.spacing = spacing;
        job.stock = {{3 * length, 3 * length, -1}};
        job.kinds = {{{{{{0, 0}, {length, height / 10}, {length / 2, height}}, {}}}, turns({0, 90})},
                     {{{rectangle(length, length / 10), {}}}, turns({0, 90})}};
        for (int i = 0; i < 8; ++i) job.items.push_back({i % 2, -1, {}});
        expect_sound(job, nest(job, little()));
    }
}

TEST_F(Nest, AFullStockIsSearchedBeforeItIsCalledUsedUp) {
    // Two L shapes fill a sheet only when one is turned into the other; placed one by one they may not.
    NestJob job;
    job.kinds = {{{{{{0, 0}, {100, 0}, {100, 20}, {20, 20}, {20, 80}, {0, 80}}, {}}}, turns({0, 180})},
                 {{{rectangle(38, 78), {}}}, turns({0})}};
    job.items = {{0, -1, {}}, {0, -1, {}}, {1, -1, {}}};
    job.stock = {{160, 100, 1}};
    expect_sound(job, nest(job, NestEffort{.work = 1e6, .seconds = {}, .progress = {}}));
}

TEST_F(Nest, StopsWhenToldAndKeepsWhatItHas) {
    std::mt19937 random(7);
    const NestJob job = random_job(random, 9);
    std::atomic<bool> stop{false};
    NestEffort effort;
    effort.seconds = 1000.0;
    effort.stop = &stop;
    int told = 0;
    effort.progress = [&](const NestProgress& progress) {
        EXPECT_GE(progress.sheets, 1);
        EXPECT_GT(progress.utilisation, 0.0);
        EXPECT_LE(progress.utilisation, 1.0 + 1e-9);
        stop = ++told >= 3;
    };
    expect_sound(job, nest(job, effort));
    EXPECT_EQ(told, 4) << "once more at the end";
}

TEST_F(Nest, NothingIsPlacedForNothing) {
    const NestResult result = nest({}, {});
    ASSERT_TRUE(result.plan.has_value());
    EXPECT_TRUE(result.plan->sheets.empty());
}

// The parts of a shape make it up exactly, whatever its form: the areas agree as whole numbers.
TEST(NestParts, ConvexPartsAreConvexAndHaveTheAreaOfTheRegion) {
    std::mt19937 random(8);
    for (int round = 0; round < 200; ++round) {
        const auto regions =
            turned_outline({random_outline(random, 30, round % 3 == 0)}, Angle::degrees(round * 7.3));
        const auto twice = [](const GridRing& ring) {
            Wide sum = 0;
            for (std::size_t i = 0; i < ring.size(); ++i) sum += cross(ring[i], ring[(i + 1) % ring.size()]);
            return sum;
        };
        Wide whole = twice(regions[0].outer);
        for (const GridRing& hole : regions[0].holes) whole += twice(hole);
        Wide parts = 0;
        for (const GridRing& part : convex_parts(regions[0])) {
            parts += twice(part);
            for (std::size_t i = 0; i < part.size(); ++i) {
                EXPECT_GT(cross(part[(i + 1) % part.size()] - part[i],
                                part[(i + 2) % part.size()] - part[(i + 1) % part.size()]),
                          0);
            }
        }
        EXPECT_TRUE(whole == parts) << round;
    }
}

TEST(NestParts, WidenedPartsAreConvexAndHoldEveryPointWithinTheWidth) {
    std::mt19937 random(12);
    for (int round = 0; round < 100; ++round) {
        const auto regions = turned_outline({random_outline(random, 30, false)}, {});
        const GridLength by = round % 4 == 0 ? 1 : to_grid(number(random, 0.001, 5));
        for (const GridRing& part : convex_parts(regions[0])) {
            const GridRing wide = widened(part, by);
            const auto n = wide.size();
            for (std::size_t i = 0; i < n; ++i) {
                const GridPoint along = wide[(i + 1) % n] - wide[i];
                EXPECT_GT(cross(along, wide[(i + 2) % n] - wide[(i + 1) % n]), 0);
                // No corner of the part is nearer to the edge's line than the width, but for rounding.
                const double length = std::hypot(static_cast<double>(along.x), static_cast<double>(along.y));
                for (const GridPoint p : part) {
                    const double away = static_cast<double>(cross(along, p - wide[i])) / length;
                    EXPECT_GE(away, static_cast<double>(by) - 1.5);
                    if (along.x == 0 || along.y == 0) {
                        EXPECT_GE(away, static_cast<double>(by));
                    }
                }
            }
        }
    }
}

// A tracing of noise: hundreds of holes, and specks that would fit into each.
TEST(NestParts, OfHundredsOfHolesTheLargestAreUsed) {
    NestJob job;
    Polygon plate{{{0, 0}, {200, 0}, {200, 200}, {0, 200}}, {}};
    for (int i = 0; i < 20; ++i) {
        for (int j = 0; j < 20; ++j) {
            const Vec2 at{2.0 + 9.0 * i, 2.0 + 9.0 * j};
            const double size = i == 3 && j == 3 ? 6.0 : 3.0;
            plate.holes.push_back({at, at + Vec2{0, size}, at + Vec2{size, size}, at + Vec2{size, 0}});
        }
    }
    job.kinds = {{{plate}, turns({0})}, {{{{{0, 0}, {2, 0}, {2, 2}, {0, 2}}, {}}}, turns({0})}};
    for (int i = 0; i < 5; ++i) job.items.push_back({i == 0 ? 0 : 1, -1, {}});
    job.stock = {{200, 200, -1}};
    const ShapeSet set = make_shapes(job);
    EXPECT_LE(set.shapes[0].parts.size(), 400U);
    EXPECT_GT(set.shapes[0].parts.size(), 100U) << "the holes that are used";
    EXPECT_FALSE(set.exact);
    const NestResult made = nest(job, {});
    expect_sound(job, made);
    EXPECT_EQ(made.plan->sheets.size(), 1U) << "the small ones lie in holes";
}

// Depth is zero exactly where the shapes do not overlap, by the integer test, and positive where they do.
TEST(NestParts, NoFitPartsTellOverlapAsTheIntegerTestDoes) {
    std::mt19937 random(10);
    NestJob job;
    for (int k = 0; k < 6; ++k) {
        job.kinds.push_back({{random_outline(random, 20, k == 5)}, turns({0, 90})});
        job.items.push_back({k, -1, {}});
    }
    job.stock = {{1000, 1000, -1}};
    const ShapeSet set = make_shapes(job);
    const ExactShapes exact(set.shapes);
    int overlapping = 0;
    for (int round = 0; round < 4000; ++round) {
        const int a = static_cast<int>(random() % set.shapes.size());
        const int b = static_cast<int>(random() % set.shapes.size());
        NoFit fit;
        make_no_fit(set.shapes[static_cast<std::size_t>(a)], set.shapes[static_cast<std::size_t>(b)], 0.0,
                    fit);
        const GridPoint at{to_grid(number(random, fit.x0 * 1e-6 - 2, fit.x1 * 1e-6 + 2)),
                           to_grid(number(random, fit.y0 * 1e-6 - 2, fit.y1 * 1e-6 + 2))};
        double deepest = -HUGE_VAL;
        for (const NoFitPart& part : fit.parts) {
            const auto x = static_cast<double>(at.x);
            const auto y = static_cast<double>(at.y);
            const double depth = depth_in(fit, part, x, y);
            deepest = std::max(deepest, depth);
        }
        if (std::abs(deepest) < 1.0) continue;  // as near as rounding
        const bool apart = exact.apart(a, at, b, {0, 0}, 0);
        EXPECT_EQ(apart, deepest < 0.0) << round;
        overlapping += apart ? 0 : 1;
    }
    EXPECT_GT(overlapping, 500);
}

}  // namespace
}  // namespace popup
