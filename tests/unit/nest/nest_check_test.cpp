// The checker of nested pieces checked: layouts made by hand, whose faults are known, and optimal layouts of
// others, which have none.
#include "support/nest_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <random>
#include <stdexcept>

#include "base/geometry/regions.h"
#include "support/nest_exact.h"
#include "support/nest_instances.h"
#include "support/run_program.h"

namespace popup::test {
namespace {

constexpr double kStep = 1e-6;

// Whether there are just as many faults as words, each with its words in it.
testing::AssertionResult says(const std::vector<std::string>& faults, const std::vector<std::string>& words) {
    bool same = faults.size() == words.size();
    for (std::size_t i = 0; same && i < words.size(); ++i)
        same = faults[i].find(words[i]) != std::string::npos;
    if (same) return testing::AssertionSuccess();
    auto failure = testing::AssertionFailure() << faults.size() << " faults, expected " << words.size();
    for (const std::string& fault : faults) failure << "\n  " << fault;
    return failure;
}

Polygon box(double x0, double y0, double x1, double y1) {
    return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}
Polygon framed(double size, double rim) {
    Polygon polygon = box(0, 0, size, size);
    polygon.holes = {{{rim, rim}, {rim, size - rim}, {size - rim, size - rim}, {size - rim, rim}}};
    return polygon;
}

// A job of these pieces, each a kind of its own, on 100 × 100 mm sheets without end.
struct Hand {
    NestJob job;
    NestPlan plan;

    Hand() { job.stock = {{100.0, 100.0, -1}}; }
    Hand& put(Polygon polygon, Vec2 offset, int sheet = 0, double deg = 0.0) {
        NestKind kind{{std::move(polygon)}, {Angle::degrees(deg)}};
        job.items.push_back({static_cast<int>(job.kinds.size()), -1, std::nullopt});
        job.kinds.push_back(std::move(kind));
        plan.spots.push_back({sheet, offset, Angle::degrees(deg)});
        return *this;
    }
    // With `used` worked out in doubles, as far as the sheets go.
    std::vector<std::string> faults() {
        plan.sheets.clear();
        plan.used.clear();
        for (std::size_t i = 0; i < plan.spots.size(); ++i) {
            const auto sheet = static_cast<std::size_t>(plan.spots[i].sheet);
            if (plan.sheets.size() <= sheet) {
                plan.sheets.resize(sheet + 1, 0);
                plan.used.resize(sheet + 1);
            }
            const auto kind = static_cast<std::size_t>(job.items[i].kind);
            for (const Vec2 p : job.kinds[kind].outline.front().outer) {
                const Vec2 q = rotated(p, plan.spots[i].angle.rad()) + plan.spots[i].offset;
                plan.used[sheet] = {std::max(plan.used[sheet].x, q.x), std::max(plan.used[sheet].y, q.y)};
            }
        }
        return nest_faults(job, plan);
    }
};

class NestCheck : public testing::Test {
 protected:
    void SetUp() override {
        if (!nest_check_available()) GTEST_SKIP() << kNestCheckMissing;
    }
};

TEST_F(NestCheck, PiecesThatTouchAlongAnEdgeOrAtACornerPass) {
    EXPECT_TRUE(says(Hand()
                         .put(box(0, 0, 10, 10), {})
                         .put(box(0, 0, 10, 10), {10, 0})
                         .put(box(0, 0, 5, 5), {10, 10})
                         .faults(),
                     {}));
    // Edges that lie in each other only in part, askew.
    const Polygon up{{{0, 0}, {30, 10}, {0, 20}}, {}};
    const Polygon down{{{0, 0}, {21, 7}, {21, 0}}, {}};
    EXPECT_TRUE(says(Hand().put(up, {}).put(down, {3, 1}).faults(), {}));
    EXPECT_TRUE(says(Hand().put(up, {}).put(down, {3, 1 + kStep}).faults(), {"overlap"}));
    const Polygon below{{{3, 1}, {3, 0}, {24, 0}, {24, 8}}, {}};
    EXPECT_TRUE(says(Hand().put(up, {}).put(below, {}).faults(), {}));
}

TEST_F(NestCheck, AnOverlapByOneStepOfTheGridIsFoundWithItsAmount) {
    const auto faults = Hand().put(box(0, 0, 10, 10), {}).put(box(0, 0, 10, 10), {10 - kStep, 2}).faults();
    EXPECT_TRUE(says(faults, {"items 0 and 1 on sheet 0 overlap by 8e-06 mm², in (9.999999, "
                              "2.000000) to (10.000000, 10.000000)"}));
    // A corner that stands one step over a long slanting edge: (21, 7) + (0, 1 step).
    const Polygon up{{{0, 0}, {30, 10}, {0, 20}}, {}};
    const Polygon over{{{21, 7 + kStep}, {20, 1}, {22, 1}}, {}};
    EXPECT_TRUE(says(Hand().put(up, {}).put(over, {}).faults(), {"overlap"}));
}

TEST_F(NestCheck, PiecesOnTopOfEachOtherAreFoundThoughNoEdgesCross) {
    EXPECT_TRUE(says(Hand().put(box(0, 0, 10, 10), {5, 5}).put(box(0, 0, 10, 10), {5, 5}).faults(),
                     {"overlap by 100 mm²"}));
    EXPECT_TRUE(
        says(Hand().put(framed(10, 2), {5, 5}).put(framed(10, 2), {5, 5}).faults(), {"overlap by 64 mm²"}));
    EXPECT_TRUE(
        says(Hand().put(box(0, 0, 5, 5), {}).put(box(0, 0, 5, 5), {}).put(box(0, 0, 5, 5), {}).faults(),
             {"items 0 and 1", "items 0 and 2", "items 1 and 2"}));
}

TEST_F(NestCheck, APieceWhollyInsideAnotherIsFound) {
    EXPECT_TRUE(
        says(Hand().put(box(0, 0, 20, 20), {}).put(box(0, 0, 4, 4), {8, 8}).faults(), {"overlap by 16 mm²"}));
    // In a hole it is not, unless holes may not be used; nor is a piece round it, in whichever order.
    Hand in_hole;
    in_hole.put(box(0, 0, 4, 4), {8, 8}).put(framed(20, 3), {});
    EXPECT_TRUE(says(in_hole.faults(), {}));
    in_hole.job.use_holes = false;
    EXPECT_TRUE(says(in_hole.faults(), {"overlap by 16 mm²"}));
}

TEST_F(NestCheck, APieceMayFillANotchOrAHoleExactly) {
    const Polygon notched{{{0, 0}, {30, 0}, {30, 20}, {20, 20}, {20, 5}, {10, 5}, {10, 20}, {0, 20}}, {}};
    EXPECT_TRUE(says(Hand().put(notched, {}).put(box(0, 0, 10, 15), {10, 5}).faults(), {}));
    EXPECT_TRUE(says(Hand().put(notched, {}).put(box(0, 0, 10 + kStep, 15), {10, 5}).faults(),
                     {"overlap by 1.5e-05 mm²"}));
    EXPECT_TRUE(says(Hand().put(framed(20, 3), {}).put(box(0, 0, 14, 14), {3, 3}).faults(), {}));
    EXPECT_TRUE(
        says(Hand().put(framed(20, 3), {}).put(box(0, 0, 14, 14 + kStep), {3, 3}).faults(), {"overlap"}));
}

TEST_F(NestCheck, SpacingHoldsToTheStep) {
    const auto with_gap = [](Vec2 offset) {
        Hand hand;
        hand.job.spacing = 2.0;
        return hand.put(box(0, 0, 10, 10), {}).put(box(0, 0, 10, 10), offset).faults();
    };
    EXPECT_TRUE(says(with_gap({12, 0}), {}));
    EXPECT_TRUE(
        says(with_gap({12 - kStep, 0}), {"items 0 and 1 on sheet 0 are 1.999999 mm apart, 1e-06 mm less"}));
    EXPECT_TRUE(says(with_gap({10, 3}), {"are 0.000000 mm apart"}));
    // Corner to corner: 1.2 and 1.6 mm make 2.
    EXPECT_TRUE(says(with_gap({11.2, 11.6}), {}));
    EXPECT_TRUE(says(with_gap({11.2, 11.6 - kStep}), {"mm apart"}));
    // An overlap is said once.
    EXPECT_TRUE(says(with_gap({9, 0}), {"overlap"}));
}

TEST_F(NestCheck, SpacingHoldsFromACornerToASlantingEdge) {
    // The edge from (0, 0) to (40, 30); (50, 0) less 3-4-5 steps along it is 20 mm from the edge at (32,
    // 24)...
    Hand hand;
    hand.job.spacing = 15.0;
    const Polygon slope{{{0, 0}, {40, 30}, {0, 30}}, {}};
    const Polygon point{{{25, 0}, {60, 0}, {60, 5}}, {}};  // (25, 0) is 25 · 3/5 = 15 mm off
    EXPECT_TRUE(says(hand.put(slope, {}).put(point, {}).faults(), {}));
    Hand closer;
    closer.job.spacing = 15.0;
    EXPECT_TRUE(says(closer.put(slope, {}).put(point, {-kStep, 0}).faults(), {"mm apart"}));
}

TEST_F(NestCheck, SpacingHoldsInHoles) {
    const auto in_hole = [](double x) {
        Hand hand;
        hand.job.spacing = 2.0;
        return hand.put(framed(20, 3), {}).put(box(0, 0, 4, 4), {x, 8}).faults();
    };
    EXPECT_TRUE(says(in_hole(5), {}));
    EXPECT_TRUE(says(in_hole(5 - kStep), {"1e-06 mm less"}));
}

TEST_F(NestCheck, SeveralPolygonsOfOneOutlineMayTouchAndHaveSpacingToOthersOnly) {
    Hand hand;
    hand.job.spacing = 2.0;
    hand.put(box(0, 0, 10, 10), {}).put(box(0, 0, 5, 5), {22, 0});
    hand.job.kinds[0].outline.push_back(box(10, 0, 20, 5));
    hand.job.kinds[0].outline.push_back(box(0, 10.5, 10, 12));
    hand.faults();
    hand.plan.used = {{27, 12}};
    EXPECT_TRUE(says(nest_faults(hand.job, hand.plan), {}));
    hand.plan.spots[1].offset.x -= 1;
    hand.plan.used = {{26, 12}};
    EXPECT_TRUE(says(nest_faults(hand.job, hand.plan), {"1.000000 mm apart"}));
}

TEST_F(NestCheck, TurnedPiecesAreCheckedWhereTheyLie) {
    const Polygon slim = box(0, 0, 30, 10);
    EXPECT_TRUE(says(Hand().put(slim, {10, 0}, 0, 90).put(slim, {40, 10}, 0, 180).faults(), {}));
    EXPECT_TRUE(
        says(Hand().put(slim, {10 + kStep, 0}, 0, 90).put(slim, {40, 10}, 0, 180).faults(), {"overlap"}));
    // 270° and -90° are the same turn.
    EXPECT_TRUE(says(Hand().put(slim, {0, 30}, 0, -90).put(slim, {10, 30}, 0, 270).faults(), {}));
    // A 45° turn of a square reaches up to 10 √2, and 5 √2 to the left.
    const double half = 5.0 * std::numbers::sqrt2;
    EXPECT_TRUE(
        says(Hand().put(box(0, 0, 10, 10), {std::ceil(half / kStep) * kStep, 0}, 0, 45).faults(), {}));
    EXPECT_TRUE(says(Hand().put(box(0, 0, 10, 10), {std::floor(half / kStep) * kStep, 0}, 0, 45).faults(),
                     {"item 0 stands 0.000001 mm out of sheet 0"}));
}

TEST_F(NestCheck, PiecesOfDifferentSheetsDoNotMeet) {
    EXPECT_TRUE(says(Hand().put(box(0, 0, 10, 10), {}).put(box(0, 0, 10, 10), {}, 1).faults(), {}));
}

TEST_F(NestCheck, OverlapsOfPiecesStrewnAtRandomAreThoseOfAnotherLibrary) {
    // Holes count, whichever piece is on top; polygons of the other library stand on the same grid.
    std::mt19937_64 dice(7);
    const NestInstance large = large_nest_instance(60, 2);
    std::vector<PlacedPiece> pieces;
    std::vector<Polygon> regions;
    for (const NestItem& item : large.job.items) {
        const Vec2 at{static_cast<double>(dice() % 300), static_cast<double>(dice() % 300)};
        Polygon polygon = large.job.kinds[static_cast<std::size_t>(item.kind)].outline[0];
        PlacedPiece& piece = pieces.emplace_back();
        const auto move = [&](Ring& ring) {
            auto& spots = piece.emplace_back();
            for (Vec2& p : ring) {
                p = p + at;
                spots.push_back({std::llround(p.x * 1e6), std::llround(p.y * 1e6)});
            }
        };
        move(polygon.outer);
        for (Ring& hole : polygon.holes) move(hole);
        regions.push_back(std::move(polygon));
    }
    std::map<std::pair<int, int>, double> found;
    for (const PieceOverlap& one : piece_overlaps(pieces)) found[{one.a, one.b}] = one.area * 1e-12;
    std::size_t met = 0;
    for (int a = 0; a < 60; ++a) {
        for (int b = a + 1; b < 60; ++b) {
            double expected = 0.0;
            for (const Polygon& part :
                 intersect({regions[static_cast<std::size_t>(a)]}, {regions[static_cast<std::size_t>(b)]})) {
                expected += area(part);
            }
            if (expected > 0.0) ++met;
            EXPECT_NEAR((found[{a, b}]), expected, 1e-3) << a << " and " << b;
        }
    }
    EXPECT_GT(met, 100U);
}

// What needs no CGAL.

TEST(NestRules, APieceMayReachTheSheetsEdgeAndNoStepBeyond) {
    EXPECT_TRUE(says(Hand().put(box(0, 0, 100, 100), {}).faults(), {}));
    for (const Vec2 beyond : {Vec2{kStep, 0}, Vec2{-kStep, 0}, Vec2{0, kStep}, Vec2{0, -kStep}}) {
        EXPECT_TRUE(says(Hand().put(box(0, 0, 100, 100), beyond).faults(),
                         {"item 0 stands 0.000001 mm out of sheet 0"}));
    }
}

TEST(NestRules, EveryItemNeedsASheetThatTheStockHas) {
    Hand hand;
    hand.put(box(0, 0, 10, 10), {}).put(box(0, 0, 10, 10), {}, 1);
    EXPECT_TRUE(says(hand.faults(), {}));
    hand.job.stock[0].count = 1;
    EXPECT_TRUE(says(hand.faults(), {"2 sheets of row 0, which has 1"}));
    hand.plan.spots[1].sheet = 2;
    EXPECT_TRUE(says(nest_faults(hand.job, hand.plan), {"item 1 is on sheet 2 of 2"}));
    hand.plan.spots.pop_back();
    EXPECT_TRUE(says(nest_faults(hand.job, hand.plan), {"2 items have 1 places"}));
    Hand row;
    row.put(box(0, 0, 10, 10), {}).faults();
    row.plan.sheets[0] = 1;
    EXPECT_TRUE(says(nest_faults(row.job, row.plan), {"sheet 0 is from row 1 of 1"}));
}

TEST(NestRules, TurnsAreThoseAllowed) {
    Hand hand;
    hand.put(box(0, 0, 10, 10), {}).put(box(0, 0, 10, 10), {30, 30}, 0, 180);
    EXPECT_TRUE(says(hand.faults(), {}));
    hand.plan.spots[1].angle = Angle::degrees(90);
    EXPECT_TRUE(says(hand.faults(), {"item 1 is turned by 90°, which its kind does not allow"}));

    Hand alike;
    alike.put(box(0, 0, 10, 10), {}).put(box(0, 0, 10, 10), {30, 30}, 0, 180);
    alike.job.items[1].kind = 0;
    alike.job.kinds[0].turns.push_back(Angle::degrees(180));
    EXPECT_TRUE(says(alike.faults(), {}));
    alike.job.kinds[0].one_turn = true;
    EXPECT_TRUE(says(alike.faults(), {"items 0 and 1 of one kind are turned by 0° and 180°"}));
}

TEST(NestRules, GroupsShareASheet) {
    Hand hand;
    hand.put(box(0, 0, 10, 10), {}).put(box(0, 0, 10, 10), {20, 0}).put(box(0, 0, 10, 10), {}, 1);
    hand.job.items[0].group = 3;
    hand.job.items[1].group = 3;
    EXPECT_TRUE(says(hand.faults(), {}));
    hand.job.items[2].group = 3;
    EXPECT_TRUE(says(hand.faults(), {"items 0 and 2 of group 3 are on sheets 0 and 1"}));
}

TEST(NestRules, LockedItemsStayWhereTheyAre) {
    Hand hand;
    hand.put(box(0, 0, 10, 10), {5, 5});
    hand.job.items[0].locked = hand.plan.spots[0];
    EXPECT_TRUE(says(hand.faults(), {}));
    hand.plan.spots[0].offset.y += kStep;
    EXPECT_TRUE(says(hand.faults(), {"item 0 is locked on sheet 0 at (5, 5)"}));
}

TEST(NestRules, UsedSizesAndOffsetsAreTrue) {
    Hand hand;
    hand.put(box(0, 0, 10, 10), {5, 5}).faults();
    hand.plan.used[0].x = 16;
    EXPECT_TRUE(says(nest_faults(hand.job, hand.plan), {"sheet 0 is used to (15.000000, 15"}));
    EXPECT_TRUE(says(Hand().put(box(0, 0, 10, 10), {0.1 + 0.2, 1.0 / 1048576}).faults(), {"off the grid"}));
    hand.plan.sheets.push_back(0);
    hand.plan.used = {{15, 15}, {}};
    EXPECT_TRUE(says(nest_faults(hand.job, hand.plan), {"sheet 1, the last one, is empty"}));
}

// Instances of others.

TEST(NestInstances, EachFormIsReadWithItsTurnsCopiesHolesAndSheets) {
    const ScratchDirectory scratch;
    for (const char* folder : {"strip", "bins", "jobs"}) std::filesystem::create_directory(scratch / folder);
    write_file(
        scratch / "strip/s.json",
        R"({"strip_height": 40.004, "items": [{"id": 0, "demand": 3, "allowed_orientations": [0.0, 180.0],
                   "shape": {"type": "simple_polygon", "data": [[0,0],[0,2],[3,2],[3,0],[0,0]]}}]})");
    write_file(scratch / "bins/T.txt", " 2 1000 1000  3 0 172 0 0 136 0 3 0 314 0 0 408 0");
    write_file(scratch / "bins/OpT.txt", " 1 2 1000 1000  3 0 172 0 0 136 0 3 592 0 1000 0 592 314");
    write_file(scratch / "jobs/j.json",
               R"({"parameters": {"item_item_minimum_spacing": 2.5},
                   "bin_types": [{"type": "rectangle", "copies": 4, "width": 30, "height": 20,
                                  "item_bin_minimum_spacing": 1}, {"width": 8, "height": 9}],
                   "item_types": [
                     {"copies": 2, "allowed_rotations": [{"start": 0, "end": 0}, {"start": 90, "end": 90}],
                      "shapes": [{"type": "polygon",
                        "vertices": [{"x":0,"y":0},{"x":6,"y":0},{"x":6,"y":6},{"x":0,"y":6}],
                        "holes": [{"type": "polygon", "vertices": [{"x":1,"y":1},{"x":3,"y":1},{"x":1,"y":3}]}]}]},
                     {"type": "polygon", "vertices": [{"x":0,"y":0},{"x":0,"y":1},{"x":1,"y":0}]}]})");
    const auto all = nest_instances(scratch.path());
    ASSERT_EQ(all.size(), 3U);

    EXPECT_EQ(all[0].name, "strip/s");
    EXPECT_EQ(all[0].job.items.size(), 3U);
    EXPECT_EQ(all[0].area, 18.0);  // whichever way the file goes round
    EXPECT_EQ(all[0].job.kinds[0].outline[0].outer.size(), 4U);
    EXPECT_EQ(all[0].job.kinds[0].turns, (std::vector{Angle{}, Angle::degrees(180)}));
    EXPECT_EQ(all[0].job.stock[0].height, 40.004);
    EXPECT_EQ(all[0].job.stock[0].count, 1);
    EXPECT_GE(all[0].job.stock[0].width, 9.0);

    EXPECT_EQ(all[1].name, "bins/T");
    EXPECT_EQ(all[1].optimum, 1);
    EXPECT_EQ(all[1].job.items.size(), 2U);
    EXPECT_EQ(all[1].job.stock[0].count, -1);
    EXPECT_EQ(all[1].job.kinds[1].turns, std::vector{Angle{}});
    const auto optimum = nest_optimum(scratch.path(), "bins/T");
    ASSERT_TRUE(optimum);
    EXPECT_TRUE(says(nest_faults(optimum->job, optimum->plan), {}));

    EXPECT_EQ(all[2].name, "jobs/j");
    EXPECT_EQ(all[2].job.spacing, 2.5);
    ASSERT_EQ(all[2].job.stock.size(), 2U);
    EXPECT_EQ(all[2].job.stock[0].width, 28.0);
    EXPECT_EQ(all[2].job.stock[0].height, 18.0);
    EXPECT_EQ(all[2].job.stock[0].count, 4);
    EXPECT_EQ(all[2].job.stock[1].count, -1);
    EXPECT_EQ(all[2].job.items.size(), 3U);
    EXPECT_EQ(all[2].area, 2.0 * 34.0 + 0.5);
    EXPECT_EQ(all[2].job.kinds[0].turns, (std::vector{Angle{}, Angle::degrees(90)}));
    EXPECT_EQ(all[2].job.kinds[1].turns, std::vector{Angle{}});

    EXPECT_EQ(nest_instances(scratch.path(), {"bins", "nothing"}).size(), 1U);
    write_file(scratch / "jobs/j.json", "{}");
    EXPECT_THROW(nest_instances(scratch.path()), std::runtime_error);
}

// What others laid out.

TEST_F(NestCheck, OptimalLayoutsOfOthersPassAndFailOnceAPieceIsMovedByAStep) {
    const auto data = nest_data();
    if (!data) GTEST_SKIP() << kNestDataMissing;
    const auto instances = nest_instances(*data, {"bins/"});
    ASSERT_FALSE(instances.empty());
    for (const NestInstance& instance : instances) {
        auto solution = nest_optimum(*data, instance.name);
        ASSERT_TRUE(solution) << instance.name;
        EXPECT_TRUE(says(nest_faults(solution->job, solution->plan), {})) << instance.name;
        EXPECT_EQ(static_cast<int>(solution->plan.sheets.size()), instance.optimum);
        EXPECT_EQ(solution->job.items.size(), instance.job.items.size());
        // All sheets are full: wherever a piece goes it is out of the sheet or in another.
        solution->plan.spots[1].offset = {kStep, 0};
        EXPECT_FALSE(nest_faults(solution->job, solution->plan).empty()) << instance.name;
    }
}

TEST_F(NestCheck, AThousandPiecesTakeSeconds) {
    // In rows, each in a box of its own.
    NestInstance large = large_nest_instance(1000, 1);
    ASSERT_EQ(large.job.items.size(), 1000U);
    large.job.stock = {{20000.0, 20000.0, -1}};
    NestPlan plan{{}, {0}, {{}}};
    for (std::size_t i = 0; i < large.job.items.size(); ++i) {
        const Vec2 at{130.0 * static_cast<double>(i % 40), 130.0 * static_cast<double>(i / 40)};
        plan.spots.push_back({0, at + Vec2{100, 100}, {}});
        for (const Vec2 p :
             large.job.kinds[static_cast<std::size_t>(large.job.items[i].kind)].outline[0].outer) {
            const Vec2 q = p + plan.spots.back().offset;
            plan.used[0] = {std::max(plan.used[0].x, q.x), std::max(plan.used[0].y, q.y)};
        }
    }
    const auto start = std::chrono::steady_clock::now();
    EXPECT_TRUE(says(nest_faults(large.job, plan), {}));
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    EXPECT_LT(taken.count(), 20.0);  // a fifth of a second, but for a sanitizer
    plan.spots[400] = plan.spots[401];
    EXPECT_TRUE(says(nest_faults(large.job, plan), {"items 400 and 401 on sheet 0 overlap"}));
}

}  // namespace
}  // namespace popup::test
