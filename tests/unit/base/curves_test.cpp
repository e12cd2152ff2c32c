// Curves that polygons are made of, found again: whole ones, what is left of cut ones, and never a wrong one.
#include "popup/curves.h"

#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "base/geometry/regions.h"
#include "support/random.h"
#include "support/restored.h"
#include "support/sanitized.h"

namespace popup {
namespace {

using test::curves_in;
using test::Random;
using test::strays;

// The tolerance of chords, and of rounding.
constexpr double kNearMm = kFlatMm + 2e-4;

struct Drawn {
    Flattened flat;
    CurveTable table;
    [[nodiscard]] const std::vector<Vec2>& points(std::size_t i = 0) const { return flat.lines.at(i).points; }
};

Drawn drawn(const std::string& data) {
    Path path;
    EXPECT_FALSE(parse_path(data, path)) << data;
    Drawn made;
    EXPECT_EQ(flatten(path, made.flat), FlatteningFault::none);
    made.table = CurveTable(made.flat.curves);
    return made;
}

// Four cubics and two lines.
constexpr const char* kLeaf =
    "M20 10 C40 0 70 5 80 20 C90 40 60 60 50 55 L40 70 C20 70 5 60 10 40 C12 30 5 20 12 12 Z";

TEST(Curves, AWholePathIsItsCurvesAgain) {
    const Drawn leaf = drawn(kLeaf);
    const Restored restored = leaf.table.restored(leaf.points(), true, false);
    ASSERT_EQ(restored.steps.size(), 6U);
    EXPECT_EQ(curves_in(restored), 4U);
    EXPECT_NEAR(restored.steps[0].control_1.x, 40.0, 1e-5);
    EXPECT_NEAR(restored.steps[0].control_1.y, 0.0, 1e-5);
    EXPECT_NEAR(restored.steps[0].control_2.x, 70.0, 1e-5);
    EXPECT_NEAR(leaf.points()[restored.steps[0].to].x, 80.0, 1e-6);
    EXPECT_LE(strays(leaf.points(), true, restored), kNearMm);
    EXPECT_GT(strays(leaf.points(), true, restored), 1e-3) << "chords that do not stray are no test";
}

TEST(Curves, APathMayRunBackwardsAndBeginAnywhere) {
    const Drawn leaf = drawn(kLeaf);
    std::vector<Vec2> points = leaf.points();
    for (const bool backwards : {false, true}) {
        for (std::size_t i = 0; i < points.size(); i += 4) {
            std::rotate(points.begin(), points.begin() + 4, points.end());
            const Restored moved = leaf.table.restored(points, true, false);
            EXPECT_EQ(curves_in(moved), 4U) << i;
            EXPECT_LE(strays(points, true, moved), kNearMm) << i;
            const Restored kept = leaf.table.restored(points, true, true);
            EXPECT_EQ(kept.start, 0U);
            EXPECT_GE(curves_in(kept), 4U) << i;
            EXPECT_LE(curves_in(kept), 5U) << i;
            EXPECT_LE(strays(points, true, kept), kNearMm) << i;
        }
        std::reverse(points.begin(), points.end());
        if (backwards) break;
    }
}

TEST(Curves, BooleansLeaveWhatTheyDoNotCut) {
    const Drawn leaf = drawn(kLeaf);
    // It cuts the second curve twice.
    const std::vector<Polygon> left =
        subtract({{leaf.points(), {}}}, {{{{70, 30}, {100, 30}, {100, 45}, {70, 45}}, {}}});
    ASSERT_EQ(left.size(), 1U);
    const Restored restored = leaf.table.restored(left[0].outer, true, false);
    EXPECT_EQ(curves_in(restored), 5U);
    EXPECT_LE(strays(left[0].outer, true, restored), kNearMm);
    // What is cut of the second curve is less than a fifth of its chords; all others are in curves.
    std::size_t straight = 0;
    for (const CurveStep& step : restored.steps) straight += step.curve ? 0 : 1;
    EXPECT_LE(straight, 2U + 3U + 2U);  // drawn ones, the cut's, and two chords that were cut in two
}

TEST(Curves, OfTwoCurvesWithTheSameEndsEachIsItsOwn) {
    const Drawn lens = drawn("M0 0 C10 12 30 12 40 0 C30 -12 10 -12 0 0 Z M0 0 C10 12 30 12 40 0 L20 -30 Z");
    for (std::size_t i = 0; i < 2; ++i) {
        const Restored restored = lens.table.restored(lens.points(i), true, false);
        EXPECT_EQ(curves_in(restored), i == 0 ? 2U : 1U);
        EXPECT_LE(strays(lens.points(i), true, restored), kNearMm);
    }
    // The chord of a curve is not the curve.
    const std::vector<Vec2> half{{0, 0}, {40, 0}, {20, -30}};
    EXPECT_TRUE(lens.table.restored(half, true, false).steps.empty());
    // A small lens, each side of which is one chord and nearly the other.
    const Drawn small = drawn("M0 0 C0.1 0.009 0.2 0.009 0.3 0 C0.2 -0.009 0.1 -0.009 0 0 L0.1 -5 Z");
    const Restored restored = small.table.restored(small.points(), true, false);
    EXPECT_LE(strays(small.points(), true, restored), kNearMm);
}

TEST(Curves, WhatIsMovedIsNotFound) {
    const Drawn leaf = drawn(kLeaf);
    for (const double delta : {0.05, -0.05, 0.5}) {
        for (const Polygon& one : offset({{leaf.points(), {}}}, delta, Corners::sharp))
            EXPECT_TRUE(leaf.table.restored(one.outer, true, false).steps.empty()) << delta;
    }
}

TEST(Curves, StraightCurvesStayLines) {
    const Drawn straight = drawn("M0 0 C1 0 2 0 30 0 C30 1 30.0005 10 30 20 L0 20 Z");
    EXPECT_TRUE(straight.table.empty());
}

TEST(Curves, ScaleTakesTheToleranceAlong) {
    Drawn leaf = drawn(kLeaf);
    for (const double by : {0.1, 7.3}) {
        CurveTable table = leaf.table;
        table.scale(by);
        std::vector<Vec2> points = leaf.points();
        for (Vec2& p : points) p = by * p;
        const Restored restored = table.restored(points, true, false);
        EXPECT_EQ(curves_in(restored), 4U) << by;
        EXPECT_LE(strays(points, true, restored), by * kFlatMm + 2e-4) << by;
    }
}

TEST(Curves, EndsThatWereJoinedElsewhereAreFoundThere) {
    Drawn arc = drawn("M0 0 C10 12 30 12 40 0");
    std::vector<Vec2> points = arc.points();
    const Vec2 near{40.00005, 0.00005};
    const Vec2 far{40.015, 0.0};
    points.back() = near;
    EXPECT_GT(arc.table.restored(points, false, false).steps.size(), 1U);
    const std::vector<Segment> moves{{{40, 0}, near}, {{40, 0}, far}};
    arc.table.move(moves);
    EXPECT_EQ(arc.table.restored(points, false, false).steps.size(), 1U);
    // Too far for a curve: the last chord stays.
    points.back() = far;
    const Restored restored = arc.table.restored(points, false, false);
    EXPECT_EQ(restored.steps.size(), 2U);
    EXPECT_LE(strays(points, false, restored), kNearMm);
}

TEST(Curves, AFullCircleInOnePieceIsFound) {
    const Drawn ring = drawn("M32 0 A32 32 0 1 1 -32 0 A32 32 0 1 1 32 0 Z");
    EXPECT_EQ(ring.table.size(), 12U);
    EXPECT_EQ(curves_in(ring.table.restored(ring.points(), true, false)), 12U);
    // One curve that ends where it begins.
    const Drawn drop = drawn("M0 0 C40 40 -40 40 0 0 Z");
    EXPECT_EQ(curves_in(drop.table.restored(drop.points(), true, false)), 1U);
}

// --- at random

double in(Random& random, double low, double high) { return low + (high - low) * random.unit(); }

// A star-shaped path of lines and curves, now and then a wild one.
std::string random_path(Random& random) {
    const std::size_t corners = 3 + random.below(6);
    const Vec2 middle{in(random, 20, 80), in(random, 20, 80)};
    const bool wild = random.below(4) == 0;
    const auto spot = [&](double angle) {
        const double r = in(random, 5, 40);
        const Vec2 p = middle + Vec2{r * std::cos(angle), r * std::sin(angle)};
        return std::to_string(p.x) + "," + std::to_string(p.y) + " ";
    };
    std::string data;
    for (std::size_t i = 0; i <= corners; ++i) {
        const double step = 2.0 * std::numbers::pi / static_cast<double>(corners);
        const double angle = step * static_cast<double>(i);
        const auto any = [&](double part) { return wild ? in(random, 0, 6.28) : angle - part * step; };
        if (i == 0) {
            data = "M" + spot(angle);
        } else if (random.below(3) == 0) {
            data += "L" + spot(angle);
        } else {
            data += "C" + spot(any(0.66)) + spot(any(0.33)) + spot(angle);
        }
    }
    return data + "Z";
}

TEST(Curves, AtRandomTheyStayNearWhatTheyStandFor) {
    Random random(7);
    std::size_t curves = 0;
    for (int round = 0; round < test::sanitized_count(150); ++round) {
        std::string data;
        for (std::size_t i = 0; i <= random.below(3); ++i) data += random_path(random);
        const Drawn all = drawn(data);
        std::vector<Ring> rings;
        for (const Polyline& line : all.flat.lines) rings.push_back(line.points);
        const Vec2 corner{in(random, 10, 60), in(random, 10, 60)};
        const Ring window{corner, corner + Vec2{25, 1}, corner + Vec2{20, 18}};
        std::vector<Polygon> regions = filled(rings, FillRule::non_zero);
        regions =
            random.below(2) == 0 ? subtract(regions, {{window, {}}}) : unite({{window, {}}, regions.at(0)});
        for (const Polygon& region : regions) {
            std::vector<Ring> contours{region.outer};
            contours.insert(contours.end(), region.holes.begin(), region.holes.end());
            for (const Ring& contour : contours) {
                const bool keep = random.below(2) == 0;
                const Restored restored = all.table.restored(contour, true, keep);
                EXPECT_LE(strays(contour, true, restored), 0.011) << data;
                curves += curves_in(restored);
            }
        }
    }
    EXPECT_GT(curves, test::sanitized_count<std::size_t>(500));
}

TEST(Curves, AtRandomAWholeDrawingComesBack) {
    Random random(11);
    for (int round = 0; round < test::sanitized_count(100); ++round) {
        const std::string data = random_path(random);
        const Drawn one = drawn(data);
        const Restored restored = one.table.restored(one.points(), true, true);
        EXPECT_EQ(curves_in(restored), one.table.size()) << data;
        EXPECT_LE(strays(one.points(), true, restored), 0.011) << data;
    }
}

}  // namespace
}  // namespace popup
