// Kerf compensation: every check here measures distances and areas itself, edge by edge, and knows nothing of
// offsets of polygons.
#include "fabrication/kerf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "support/kerf_example.h"
#include "support/random.h"

namespace popup {
namespace {

using test::attempt;
using test::closed;
using test::distance_to;
using test::edges;
using test::expect_error;
using test::move_hole;
using test::Outcome;
using test::piece_of;
using test::rectangle_at;
using test::reversed;
using test::turned;

constexpr double kPi = std::numbers::pi;

// The moved ring of a piece that has only this one.
Ring move_edge(const Ring& ring, double kerf) {
    const Outcome result = attempt(piece_of({closed(ring)}), {kerf, kerf});
    EXPECT_TRUE(result.cuts.has_value()) << (result.found.empty() ? "" : result.found[0].message);
    return result.cuts ? result.cuts->at(0).points : Ring{};
}

// ---- measures that use nothing of the code under test ----

double distance_to_corners(const Ring& ring, Vec2 p) {
    double best = HUGE_VAL;
    for (const Vec2 q : ring) best = std::min(best, distance(p, q));
    return best;
}

// What the area grows by when all edges of a counter-clockwise ring move outwards by `delta` and none is
// lost: a strip along each, and at each corner two right triangles, taken away where the ring turns right.
// Corners under 60° are cut square.
double growth(const Ring& ring, double delta) {
    double total = delta * perimeter(ring);
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 in = ring[(i + 1) % ring.size()] - ring[i];
        const Vec2 out = ring[(i + 2) % ring.size()] - ring[(i + 1) % ring.size()];
        const double turn = std::atan2(cross(in, out), dot(in, out));
        const bool square = turn * delta > 0.0 && std::abs(turn) > 2 * kPi / 3;
        total += delta * delta * (square ? 2 * std::tan(turn / 4) : std::tan(turn / 2));
    }
    return total;
}

// The path of a counter-clockwise ring, moved by `delta` (outwards when positive), is where it should be.
void expect_moved(const Ring& drawn, const Ring& path, double delta) {
    constexpr double kExact = 1e-5;
    const double half = std::abs(delta);
    const auto old_edges = edges(drawn);
    for (const Segment& s : edges(path)) {
        for (const Segment& t : old_edges) ASSERT_GE(distance(s, t), half - kExact);
        for (int i = 0; i <= 8; ++i) {
            const Vec2 p = lerp(s.a, s.b, i / 8.0);
            const double d = distance_to(drawn, p);
            // Only in mitres is the path further off, where a corner is nearest, and by the limit.
            if (d > half + kExact) {
                ASSERT_NEAR(d, distance_to_corners(drawn, p), 1e-9);
                ASSERT_LE(d, 2 * half + kExact);
            }
        }
    }
    for (const Vec2 p : path) ASSERT_EQ(contains({drawn, {}}, p), delta < 0);
    EXPECT_NEAR(signed_area(path) - signed_area(drawn), growth(drawn, delta), 1e-5 * perimeter(drawn));
    // Corners stay corners: each gives one, or two where it is cut square.
    std::size_t most = drawn.size();
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const Vec2 in = drawn[(i + 1) % drawn.size()] - drawn[i];
        const Vec2 out = drawn[(i + 2) % drawn.size()] - drawn[(i + 1) % drawn.size()];
        const double turn = std::atan2(cross(in, out), dot(in, out));
        most += turn * delta > 0.0 && std::abs(turn) > 2 * kPi / 3 - 1e-6 ? 1 : 0;
    }
    EXPECT_LE(path.size(), most);
    EXPECT_GE(path.size() + 1, drawn.size());
}

Ring star(test::Random& random, int corners, double least, double most) {
    Ring ring;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * kPi * (i + 0.6 * random.unit()) / corners;
        const double r = least + (most - least) * random.unit();
        ring.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    return ring;
}

Ring convex(test::Random& random, int corners) {
    Ring ring;
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * kPi * (i + 0.8 * random.unit()) / corners;
        ring.push_back({70 * std::cos(angle), 40 * std::sin(angle)});
    }
    return turned(ring, 7 * random.unit(), {100 * random.unit(), -100 * random.unit()});
}

// ---- where the path runs ----

TEST(Kerf, ARectangularHoleIsSmallerByTheKerfAndTheEdgeLarger) {
    const PatternPiece piece =
        piece_of({closed(reversed(rectangle_at(5, 5, 10, 6)), 1), closed(rectangle_at(0, 0, 30, 20))});
    const Outcome result = attempt(piece, {0.2, 0.3});
    ASSERT_TRUE(result.cuts.has_value());
    EXPECT_TRUE(result.found.empty());
    ASSERT_EQ(result.cuts->size(), 2U);
    // Nothing rounded: the very numbers, from the same corners, in the same directions.
    EXPECT_EQ((*result.cuts)[0].points, (Ring{{5.1, 5.1}, {5.1, 10.9}, {14.9, 10.9}, {14.9, 5.1}}));
    EXPECT_EQ((*result.cuts)[1].points,
              (Ring{{-0.15, -0.15}, {30.15, -0.15}, {30.15, 20.15}, {-0.15, 20.15}}));
    EXPECT_EQ((*result.cuts)[0].depth, 1);
    EXPECT_TRUE((*result.cuts)[0].closed);
}

TEST(Kerf, WithoutAKerfNothingChanges) {
    test::Random random(3);
    const Contour hole = closed(reversed(turned(convex(random, 7), 0.1)), 1);
    const PatternPiece piece = piece_of({hole, closed(rectangle_at(-300.0 / 7, -300, 1000.0 / 3, 1000))});
    const Outcome none = attempt(piece, {});
    ASSERT_TRUE(none.cuts.has_value());
    for (std::size_t i = 0; i < 2; ++i) EXPECT_EQ((*none.cuts)[i].points, piece.cuts[i].points);
    const Outcome outer = attempt(piece, {0.0, 0.2});
    ASSERT_TRUE(outer.cuts.has_value());
    EXPECT_EQ((*outer.cuts)[0].points, piece.cuts[0].points);
    EXPECT_NE((*outer.cuts)[1].points, piece.cuts[1].points);
}

TEST(Kerf, OpenCutsStay) {
    const Contour slit{{{5, 5}, {10, 5}, {10, 8}}, false, 1};
    const Outcome result = attempt(piece_of({slit, closed(rectangle_at(0, 0, 30, 20))}), {0.2, 0.2});
    ASSERT_TRUE(result.cuts.has_value());
    EXPECT_EQ((*result.cuts)[0].points, slit.points);
    EXPECT_FALSE((*result.cuts)[0].closed);
}

TEST(Kerf, ConvexPiecesGrowByHalfTheKerfAllRound) {
    test::Random random(1);
    for (int round = 0; round < 200; ++round) {
        const Ring ring = convex(random, 3 + static_cast<int>(random.below(20)));
        const double kerf = 0.05 + 2 * random.unit();
        expect_moved(ring, move_edge(ring, kerf), 0.5 * kerf);
        if (HasFailure()) FAIL() << "round " << round;
    }
}

TEST(Kerf, StarsWithDeepNotchesMoveEdgeByEdge) {
    test::Random random(2);
    for (int round = 0; round < 200; ++round) {
        const Ring ring = star(random, 5 + static_cast<int>(random.below(20)), 15, 50);
        const double kerf = 0.05 + 0.4 * random.unit();
        expect_moved(ring, move_edge(ring, kerf), 0.5 * kerf);
        const Outcome hole = move_hole(reversed(ring), kerf);
        ASSERT_TRUE(hole.cuts.has_value());
        EXPECT_LT(signed_area(hole.cuts->at(0).points), 0.0);
        expect_moved(ring, reversed(hole.cuts->at(0).points), -0.5 * kerf);
        if (HasFailure()) FAIL() << "round " << round;
    }
}

TEST(Kerf, RingsWithIslandsKeepOrderDepthsAndDirections) {
    test::Random random(4);
    for (int round = 0; round < 50; ++round) {
        const Ring outer = star(random, 12, 60, 80);
        const Ring hole = star(random, 9, 35, 50);
        const Ring island = star(random, 7, 10, 25);
        const PatternPiece piece = piece_of({closed(island, 2), closed(reversed(hole), 1), closed(outer)});
        const Outcome result = attempt(piece, {0.3, 0.1});
        ASSERT_TRUE(result.cuts.has_value());
        const auto& cuts = *result.cuts;
        ASSERT_EQ(cuts.size(), 3U);
        for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(cuts[i].depth, 2 - static_cast<int>(i));
        expect_moved(island, cuts[0].points, 0.15);
        expect_moved(hole, reversed(cuts[1].points), -0.15);
        expect_moved(outer, cuts[2].points, 0.05);
        if (HasFailure()) FAIL() << "round " << round;
    }
}

TEST(Kerf, StartsAtTheCornerThatTheStartHasBecome) {
    test::Random random(5);
    for (int round = 0; round < 100; ++round) {
        Ring ring = star(random, 5 + static_cast<int>(random.below(20)), 15, 50);
        std::rotate(ring.begin(), ring.begin() + 3, ring.end());
        const Ring path = move_edge(ring, 0.2);
        ASSERT_FALSE(path.empty());
        // Both ends of the last edge and of the first one lie beside those of the drawn ring.
        EXPECT_LE(distance(path.front(), ring.front()), 0.1 / std::sin(0.05));
        EXPECT_NEAR(std::abs(cross(unit(ring[1] - ring[0]), path[1] - ring[0])), 0.1, 1e-5);
        const Vec2 last = unit(ring[0] - ring.back());
        EXPECT_NEAR(std::abs(cross(last, path.back() - ring[0])), 0.1, 1e-5);
        if (HasFailure()) FAIL() << "round " << round;
    }
}

TEST(Kerf, SharpCornersOfPaperAreCutSquareAndAreNotLost) {
    for (const double degrees : {59.0, 30.0, 10.0, 3.0, 1.0}) {
        const double a = degrees * kPi / 180;
        const Ring spike{{0, 0}, {50, 0}, {50 * std::cos(a), 50 * std::sin(a)}};
        const Ring path = move_edge(spike, 0.2);
        EXPECT_EQ(path.size(), 4U) << degrees;
        expect_moved(spike, path, 0.1);
        EXPECT_NEAR(length(path.front()), 0.1 / std::cos((kPi - a) / 4), 1e-5);
    }
}

// Both ends of a v-shaped notch's depth are known: the path comes as near to its end as the tool is wide.
TEST(Kerf, SharpNotchesAreNotLost) {
    for (const double degrees : {120.0, 60.0, 30.0, 10.0, 6.5}) {
        const double h = std::tan(0.5 * degrees * kPi / 180) * 10;
        const Ring ring{{-30, 0}, {30, 0}, {30, 20}, {h, 20}, {0, 10}, {-h, 20}, {-30, 20}};
        const Ring path = move_edge(ring, 0.2);
        double lowest = HUGE_VAL;
        for (const Vec2 p : path) {
            if (p.y > 1) lowest = std::min(lowest, p.y);
        }
        EXPECT_NEAR(lowest, 10 + 0.1 / std::sin(0.5 * degrees * kPi / 180), 1e-5) << degrees;
    }
}

TEST(Kerf, ANotchThatTapersOverALongWayIsAnError) {
    // Over 3.8 mm of it are narrower than the kerf.
    const double h = std::tan(1.5 * kPi / 180) * 10;
    const Ring ring{{-30, 0}, {30, 0}, {30, 20}, {h, 20}, {0, 10}, {-h, 20}, {-30, 20}};
    expect_error(attempt(piece_of({closed(ring)}), {0.2, 0.2}), "the notch at (0");
}

TEST(Kerf, SmallRoundingsOfInnerCornersAreNotLost) {
    // A rounding of the notch's corners that is smaller than the tool.
    const double r = 0.05;
    Ring ring{{-10, 0}, {10, 0}, {10, 10}, {2, 10}};
    for (int i = 0; i <= 8; ++i) {
        const double a = -i * kPi / 16;
        ring.push_back({2 - r + r * std::cos(a), 5 + r + r * std::sin(a)});
    }
    for (int i = 0; i <= 8; ++i) {
        const double a = -kPi / 2 - i * kPi / 16;
        ring.push_back({-2 + r + r * std::cos(a), 5 + r + r * std::sin(a)});
    }
    ring.push_back({-2, 10});
    ring.push_back({-10, 10});
    const Ring path = move_edge(ring, 0.2);
    for (const Vec2 p : path) EXPECT_GE(distance_to(ring, p), 0.1 - 1e-5);
    EXPECT_NEAR(signed_area(path), 20.2 * 10.2 - 3.8 * 5.0, 1e-3);
}

TEST(Kerf, CurvesOfManyShortEdgesMoveByHalfTheKerf) {
    // A round hole, and a wavy edge with waves tighter than their steps are long against the tool.
    Ring circle;
    Ring wave;
    for (int i = 0; i < 720; ++i) {
        const double a = 2 * kPi * i / 720;
        circle.push_back({5 * std::cos(a), 5 * std::sin(a)});
        const double r = 30 + 2 * std::sin(12 * a);
        wave.push_back({r * std::cos(a), r * std::sin(a)});
    }
    const Outcome hole = move_hole(reversed(circle), 0.2);
    ASSERT_TRUE(hole.cuts.has_value());
    for (const Vec2 p : hole.cuts->at(0).points) EXPECT_NEAR(length(p), 4.9, 1e-4);
    const Ring path = move_edge(wave, 0.5);
    for (const Segment& s : edges(path)) {
        const Vec2 p = lerp(s.a, s.b, 0.5);
        EXPECT_NEAR(distance_to(wave, p), 0.25, 1e-4);
    }
    EXPECT_NEAR(signed_area(path) - signed_area(wave), growth(wave, 0.25), 1e-3);
}

Ring wavy_ring(int corners, double waves, double deep) {
    Ring ring;
    for (int i = 0; i < corners; ++i) {
        const double a = 2 * kPi * i / corners;
        const double r = 30 + deep * std::sin(waves * a);
        ring.push_back({r * std::cos(a), r * std::sin(a)});
    }
    return ring;
}

TEST(Kerf, FineCurvesMoveEdgeByEdge) {
    const Ring ring = wavy_ring(1000, 7, 5);
    // Compared each with each: as few corners as are fine.
    expect_moved(ring, move_edge(ring, 0.2), 0.1);
    for (const double kerf : {0.05, 0.2, 0.5}) {
        const Outcome hole = move_hole(reversed(ring), kerf);
        ASSERT_TRUE(hole.cuts.has_value());
        const Ring path = reversed(hole.cuts->at(0).points);
        EXPECT_EQ(path.size(), ring.size());
        EXPECT_NEAR(signed_area(path) - signed_area(ring), growth(ring, -0.5 * kerf), 1e-5 * perimeter(ring));
    }
}

TEST(Kerf, FineCurvesStartWhereTheyDidAndKeepTheirDirection) {
    const Ring ring = wavy_ring(2000, 3, 1);
    for (const Ring& drawn : {ring, reversed(ring)}) {
        const Ring path = move_edge(drawn, 0.2);
        ASSERT_EQ(path.size(), drawn.size());
        for (const std::size_t i : {0, 1, 700}) EXPECT_NEAR(distance(path[i], drawn[i]), 0.1, 1e-4);
    }
}

TEST(Kerf, FineCurvesWithNarrowPlacesAreStillErrors) {
    // Waves 0.4 mm apart whose valleys are narrower than the kerf.
    const Outcome narrow = attempt(piece_of({closed(wavy_ring(20000, 400, 1))}), {0.6, 0.6});
    EXPECT_FALSE(narrow.cuts.has_value());
    ASSERT_FALSE(narrow.found.empty());
    EXPECT_EQ(narrow.found[0].code, "kerf-too-wide");
    // An outline that comes back to itself, with room for a kerf between its ends and without.
    Ring ring;
    constexpr int kSteps = 1200;
    for (int i = 0; i <= kSteps; ++i) {
        const double a = 1.9 * kPi * i / kSteps;
        ring.push_back({20 * std::cos(a), 20 * std::sin(a)});
    }
    for (int i = kSteps; i >= 0; --i) {
        const double a = 1.9 * kPi * i / kSteps;
        ring.push_back({15 * std::cos(a), 15 * std::sin(a)});
    }
    const double mouth = distance(ring[kSteps + 1], ring.back());
    EXPECT_TRUE(attempt(piece_of({closed(ring)}), {0.6 * mouth, 0.6 * mouth}).cuts.has_value());
    EXPECT_FALSE(attempt(piece_of({closed(ring)}), {mouth + 0.05, mouth + 0.05}).cuts.has_value());
}

}  // namespace
}  // namespace popup
