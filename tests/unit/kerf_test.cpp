// Kerf compensation: every check here measures distances and areas itself, edge by edge, and knows nothing of
// offsets of polygons.
#include "fabrication/kerf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>

#include "popup/compile.h"
#include "popup/files.h"
#include "support/designs.h"
#include "support/random.h"

namespace popup {
namespace {

constexpr double kPi = std::numbers::pi;

Contour closed(Ring points, int depth = 0) { return {std::move(points), true, depth}; }

Ring reversed(Ring ring) {
    std::reverse(ring.begin() + 1, ring.end());
    return ring;
}

Ring turned(Ring ring, double angle, Vec2 by = {}) {
    for (Vec2& p : ring) p = rotated(p, angle) + by;
    return ring;
}

Ring rectangle(double x, double y, double w, double h) {
    return {{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}};
}

PatternPiece piece_of(std::vector<Contour> cuts) {
    PatternPiece piece;
    piece.name = "page";
    piece.cuts = std::move(cuts);
    return piece;
}

struct Outcome {
    std::optional<std::vector<Contour>> cuts;
    std::vector<Diagnostic> found;
};

Outcome attempt(const PatternPiece& piece, const KerfWidths& kerf) {
    Diagnostics diagnostics("card.xml");
    Outcome result{compensated(piece, "castle:page", kerf, diagnostics), {}};
    result.found = diagnostics.sorted();
    return result;
}

// The moved ring of a piece that has only this one.
Ring move_edge(const Ring& ring, double kerf) {
    const Outcome result = attempt(piece_of({closed(ring)}), {kerf, kerf});
    EXPECT_TRUE(result.cuts.has_value()) << (result.found.empty() ? "" : result.found[0].message);
    return result.cuts ? result.cuts->at(0).points : Ring{};
}

// The moved hole, which is given and returned clockwise, of a large sheet.
Outcome move_hole(const Ring& hole, double kerf) {
    return attempt(piece_of({closed(hole, 1), closed(rectangle(-500, -500, 1000, 1000))}), {kerf, kerf});
}

void expect_error(const Outcome& result, const std::string& words) {
    EXPECT_FALSE(result.cuts.has_value()) << words;
    ASSERT_EQ(result.found.size(), 1U) << words;
    const Diagnostic& finding = result.found[0];
    EXPECT_EQ(finding.code, "kerf-too-wide");
    EXPECT_EQ(finding.severity, Severity::error);
    EXPECT_NE(finding.message.find("castle:page"), std::string::npos) << finding.message;
    EXPECT_NE(finding.message.find(words), std::string::npos) << finding.message;
    EXPECT_FALSE(finding.hints.empty());
}

// ---- measures that use nothing of the code under test ----

std::vector<Segment> edges(const Ring& ring) {
    std::vector<Segment> result;
    for (std::size_t i = 0; i < ring.size(); ++i) result.push_back({ring[i], ring[(i + 1) % ring.size()]});
    return result;
}

double perimeter(const Ring& ring) {
    double total = 0.0;
    for (const Segment& s : edges(ring)) total += distance(s.a, s.b);
    return total;
}

double distance_to(const Ring& ring, Vec2 p) {
    double best = HUGE_VAL;
    for (const Segment& s : edges(ring)) best = std::min(best, distance(p, s));
    return best;
}

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
        piece_of({closed(reversed(rectangle(5, 5, 10, 6)), 1), closed(rectangle(0, 0, 30, 20))});
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
    const PatternPiece piece = piece_of({hole, closed(rectangle(-300.0 / 7, -300, 1000.0 / 3, 1000))});
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
    const Outcome result = attempt(piece_of({slit, closed(rectangle(0, 0, 30, 20))}), {0.2, 0.2});
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

// ---- what the path cannot make ----

Ring notched(double width) {
    return {{-10, 0},         {10, 0},           {10, 8},           {0.5 * width, 8},
            {0.5 * width, 5}, {-0.5 * width, 5}, {-0.5 * width, 8}, {-10, 8}};
}

TEST(Kerf, ANotchNarrowerThanTheKerfIsAnError) {
    expect_error(attempt(piece_of({closed(notched(0.15))}), {0.2, 0.2}), "the notch at (0, ");
    expect_error(attempt(piece_of({closed(notched(0.15))}), {0.2, 0.2}), "about 0.15 mm wide");
    EXPECT_TRUE(attempt(piece_of({closed(notched(0.25))}), {0.2, 0.2}).cuts.has_value());
    // It is the edge's kerf that counts.
    EXPECT_TRUE(attempt(piece_of({closed(notched(0.15))}), {0.2, 0.1}).cuts.has_value());
}

TEST(Kerf, NotchesOfAnyWidthAreJudgedByTheKerf) {
    test::Random random(6);
    int errors = 0;
    for (int round = 0; round < 300; ++round) {
        const double width = 0.02 + 0.5 * random.unit();
        const double kerf = 0.02 + 0.5 * random.unit();
        if (std::abs(width - kerf) < 1e-3) continue;
        const Ring ring = turned(notched(width), 7 * random.unit(), {50 * random.unit(), 50 * random.unit()});
        const Outcome edge = attempt(piece_of({closed(ring)}), {kerf, kerf});
        EXPECT_EQ(edge.cuts.has_value(), width > kerf) << width << " " << kerf;
        EXPECT_EQ(edge.found.empty(), width > kerf);
        // The same contour as a hole has a tongue of paper there instead, which only grows.
        EXPECT_TRUE(move_hole(reversed(ring), kerf).cuts.has_value());
        errors += edge.cuts ? 0 : 1;
    }
    EXPECT_GT(errors, 50);
}

TEST(Kerf, AHoleNarrowerThanTheKerfIsAnError) {
    const Outcome lost = move_hole(reversed(rectangle(20, 30, 0.1, 5)), 0.2);
    expect_error(lost, "the hole at (20.05, 3");
    expect_error(lost, "about 0.1 mm wide, and nothing is left");
    EXPECT_TRUE(move_hole(reversed(rectangle(20, 30, 0.25, 5)), 0.2).cuts.has_value());
}

TEST(Kerf, TheHintMendsIt) {
    const Outcome lost = move_hole(reversed(rectangle(20, 30, 0.15, 5)), 0.2);
    expect_error(lost, "about 0.15 mm wide");
    EXPECT_EQ(
        lost.found[0].hints.at(0),
        "take a --kerf of 0.14 mm or less, or make the design at least 1.5 times as large with --scale");
    EXPECT_TRUE(move_hole(reversed(rectangle(20, 30, 0.15, 5)), 0.14).cuts.has_value());
    EXPECT_TRUE(move_hole(reversed(rectangle(30, 45, 0.15 * 1.5, 7.5)), 0.2).cuts.has_value());
}

TEST(Kerf, AHoleThatFallsIntoSeveralIsAnError) {
    const auto bone = [](double width) {
        const double w = 0.5 * width;
        return Ring{{-5, -2}, {-2, -2}, {-2, -w}, {2, -w}, {2, -2}, {5, -2},
                    {5, 2},   {2, 2},   {2, w},   {-2, w}, {-2, 2}, {-5, 2}};
    };
    const Outcome parted = move_hole(reversed(bone(0.15)), 0.2);
    expect_error(parted, "falls apart");
    expect_error(parted, "about 0.15 mm wide");
    EXPECT_TRUE(move_hole(reversed(bone(0.25)), 0.2).cuts.has_value());
    // Two wedges with their points towards each other leave nothing that is long and narrow.
    const auto hourglass = [](double width) {
        const double w = 0.5 * width;
        return Ring{{-5, -5}, {0, -w}, {5, -5}, {5, 5}, {0, w}, {-5, 5}};
    };
    const Outcome pinched = move_hole(reversed(hourglass(0.1)), 0.2);
    expect_error(pinched, "the hole at (0, 0) mm");
    // Here mitres would meet though the place is wider than the kerf.
    const Ring wide = hourglass(0.25);
    const Outcome whole = move_hole(reversed(wide), 0.2);
    ASSERT_TRUE(whole.cuts.has_value());
    for (const Segment& s : edges(whole.cuts->at(0).points)) {
        for (const Segment& t : edges(wide)) EXPECT_GE(distance(s, t), 0.1 - 1e-5);
        EXPECT_LE(distance_to(wide, s.a), 0.11);
    }
}

TEST(Kerf, ANotchWithANarrowMouthIsAnError) {
    const auto keyhole = [](double width) {
        const double w = 0.5 * width;
        return Ring{{-10, 0}, {10, 0}, {10, 10}, {w, 10}, {w, 8},   {3, 8},
                    {3, 4},   {-3, 4}, {-3, 8},  {-w, 8}, {-w, 10}, {-10, 10}};
    };
    const Outcome shut = attempt(piece_of({closed(keyhole(0.1))}), {0.2, 0.2});
    expect_error(shut, "the way into a notch at (");
    EXPECT_TRUE(attempt(piece_of({closed(keyhole(0.3))}), {0.2, 0.2}).cuts.has_value());
}

TEST(Kerf, AHoleWithALongNarrowEndIsAnError) {
    const auto pan = [](double width) {
        return Ring{{0, 0}, {8, 0}, {8, 3}, {20, 3}, {20, 3 + width}, {8, 3 + width}, {8, 8}, {0, 8}};
    };
    expect_error(move_hole(reversed(pan(0.15)), 0.2), "the end of a hole at (");
    EXPECT_TRUE(move_hole(reversed(pan(0.25)), 0.2).cuts.has_value());
}

TEST(Kerf, ContoursWithTooLittleWasteBetweenThemAreAnError) {
    const auto pair = [](double gap) {
        return piece_of({closed(rectangle(0, 0, 10, 10)), closed(rectangle(10 + gap, 0, 10, 10))});
    };
    expect_error(attempt(pair(0.1), {0.0, 0.2}), "0.1 mm apart at (10");
    EXPECT_TRUE(attempt(pair(0.3), {0.0, 0.2}).cuts.has_value());
    const auto nested = [](double gap) {
        return piece_of({closed(rectangle(10 + gap, 12, 5, 5), 2),
                         closed(reversed(rectangle(10, 10, 10, 10)), 1), closed(rectangle(0, 0, 40, 40))});
    };
    expect_error(attempt(nested(0.1), {0.2, 0.0}), "0.1 mm apart");
    EXPECT_TRUE(attempt(nested(0.1), {0.0, 0.2}).cuts.has_value());
    EXPECT_TRUE(attempt(nested(0.3), {0.2, 0.2}).cuts.has_value());
    // Between two holes, and between a hole and the edge, there is paper, which only gets wider.
    const PatternPiece bridges =
        piece_of({closed(rectangle(7, 7, 1, 1), 2), closed(reversed(rectangle(5, 5, 5, 5)), 1),
                  closed(reversed(rectangle(10.05, 5, 5, 5)), 1), closed(rectangle(4.95, 0, 40, 40))});
    EXPECT_TRUE(attempt(bridges, {0.2, 0.2}).cuts.has_value());
}

TEST(Kerf, OneFindingNamesTheNarrowestAndCountsTheOthers) {
    PatternPiece piece = piece_of({});
    for (int i = 0; i < 5; ++i) {
        piece.cuts.push_back(closed(reversed(rectangle(10.0 * i, 5, i == 3 ? 0.05 : 0.12, 4)), 1));
    }
    piece.cuts.push_back(closed(rectangle(-10, -10, 100, 100)));
    const Outcome result = attempt(piece, {0.2, 0.2});
    expect_error(result, "the hole at (30.0");
    expect_error(result, "about 0.05 mm wide");
    expect_error(result, "4 more places");
}

// ---- layouts ----

Layout layout_of(std::vector<PatternPiece> pieces, int copies) {
    Layout layout;
    layout.margin_mm = 5.0;
    layout.prefix_names = true;
    layout.sheets.resize(1);
    DesignPattern design;
    design.file = "castle.xml";
    design.stem = "castle";
    design.pattern.pieces = std::move(pieces);
    for (int copy = 0; copy < copies; ++copy) {
        for (int p = 0; p < static_cast<int>(design.pattern.pieces.size()); ++p)
            layout.placements.push_back({0, p, copy, 0, {}, {}});
    }
    layout.designs.push_back(std::move(design));
    return layout;
}

TEST(Kerf, PiecesAreMovedOnceHoweverManyCopiesThereAre) {
    Layout layout = layout_of({piece_of({closed(rectangle(0, 0, 10, 10))})}, 3);
    Diagnostics diagnostics;
    EXPECT_TRUE(apply_kerf(layout, {0.2, 0.2}, 2.0, diagnostics));
    EXPECT_FALSE(diagnostics.has_findings());
    EXPECT_EQ(layout.designs[0].pattern.pieces[0].cuts[0].points,
              (Ring{{-0.1, -0.1}, {10.1, -0.1}, {10.1, 10.1}, {-0.1, 10.1}}));
}

TEST(Kerf, EveryFailingPieceIsNamedOnceAndTheLayoutStays) {
    PatternPiece good = piece_of({closed(rectangle(0, 0, 10, 10))});
    PatternPiece bad =
        piece_of({closed(reversed(rectangle(2, 2, 0.1, 5)), 1), closed(rectangle(0, 0, 10, 10))});
    for (const int failing : {1, 7, 20, 25}) {
        std::vector<PatternPiece> pieces{good};
        for (int i = 0; i < failing; ++i) {
            pieces.push_back(bad);
            pieces.back().name = "p" + std::to_string(i);
        }
        Layout layout = layout_of(pieces, 4);
        Diagnostics diagnostics;
        EXPECT_FALSE(apply_kerf(layout, {0.2, 0.2}, 2.0, diagnostics));
        const auto found = diagnostics.sorted();
        ASSERT_EQ(found.size(), static_cast<std::size_t>(std::min(failing, 20)));
        for (std::size_t i = 0; i < found.size(); ++i) {
            EXPECT_EQ(found[i].element, "p" + std::to_string(i));
            EXPECT_NE(found[i].message.find("castle:p" + std::to_string(i)), std::string::npos);
            EXPECT_EQ(found[i].file, "castle.xml");
        }
        EXPECT_EQ(found.back().message.find("(5 more pieces are not listed)") != std::string::npos,
                  failing == 25);
        EXPECT_EQ(layout.designs[0].pattern.pieces[0].cuts[0].points, good.cuts[0].points);
    }
}

TEST(Kerf, NeighboursMustBeAsFarApartAsTheKerfIsWide) {
    const PatternPiece plain = piece_of({closed(rectangle(0, 0, 10, 10))});
    const PatternPiece holed =
        piece_of({closed(reversed(rectangle(2, 2, 5, 5)), 1), closed(rectangle(0, 0, 10, 10))});
    const auto works = [](const PatternPiece& piece, int copies, const KerfWidths& kerf, double spacing) {
        Layout layout = layout_of({piece}, copies);
        Diagnostics diagnostics;
        const bool good = apply_kerf(layout, kerf, spacing, diagnostics);
        const auto found = diagnostics.sorted();
        EXPECT_EQ(found.size(), good ? 0U : 1U);
        if (!good) {
            EXPECT_EQ(found[0].code, "kerf-too-wide");
            EXPECT_NE(found[0].hints.at(0).find("--spacing"), std::string::npos);
        }
        return good;
    };
    EXPECT_FALSE(works(plain, 2, {0.2, 0.2}, 0.1));
    EXPECT_TRUE(works(plain, 2, {0.2, 0.2}, 0.2));
    EXPECT_TRUE(works(plain, 1, {0.2, 0.2}, 0.1));  // no neighbour
    EXPECT_TRUE(works(plain, 2, {0.4, 0.2}, 0.2));
    EXPECT_FALSE(works(holed, 2, {0.4, 0.2}, 0.2));  // one might lie in the other's hole
    EXPECT_TRUE(works(holed, 2, {0.4, 0.2}, 0.3));
}

// ---- real designs ----

TEST(Kerf, SamplesCanBeCutWithALaser) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::string(POPUP_SOURCE_DIR) + "/samples")) {
        const auto suffix = entry.path().extension();
        if (suffix == ".xml" || suffix == ".svg") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    ASSERT_GT(files.size(), 10U);
    for (const auto& file : files) {
        Diagnostics reading;
        const auto source = read_source(file.string(), reading);
        ASSERT_TRUE(source.has_value()) << file;
        CompileOptions options;
        options.until = Stage::pattern;
        const Compilation compiled = compile({*source}, options, {});
        ASSERT_EQ(compiled.designs.size(), 1U);
        ASSERT_TRUE(compiled.designs[0].pattern.has_value()) << file;
        for (const PatternPiece& piece : compiled.designs[0].pattern->pieces) {
            const Outcome result = attempt(piece, {0.2, 0.2});
            ASSERT_TRUE(result.cuts.has_value()) << file << ": " << result.found[0].message;
            for (std::size_t i = 0; i < piece.cuts.size(); ++i) {
                if (!piece.cuts[i].closed) continue;
                for (const Vec2 p : (*result.cuts)[i].points) {
                    EXPECT_GE(distance_to(piece.cuts[i].points, p), 0.1 - 1e-5) << file;
                }
            }
        }
    }
}

// Whether two edges that are not neighbours come nearer to each other than `width`.
bool has_narrow_place(const Ring& ring, double width) {
    const auto all = edges(ring);
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (std::size_t j = i + 2; j < all.size(); ++j) {
            if (i == 0 && j + 1 == all.size()) continue;
            if (distance(all[i], all[j]) < width) return true;
        }
    }
    return false;
}

// Where tabs are trimmed by others wedges can be left between them that are too narrow for any tool. There
// are few, and only there may a piece be refused.
TEST(Kerf, TabsOfGeneratedDesignsCanBeCutWithALaser) {
    int pieces = 0;
    int refused = 0;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        const auto built = test::build(test::generate(seed, 4 + static_cast<int>(seed % 20)));
        ASSERT_TRUE(built.assembly.has_value());
        Diagnostics diagnostics;
        const auto pattern = make_pattern(*built.assembly, {}, diagnostics);
        ASSERT_TRUE(pattern.has_value());
        for (const PatternPiece& piece : pattern->pieces) {
            ++pieces;
            const Outcome result = attempt(piece, {0.2, 0.2});
            if (result.cuts) continue;
            ++refused;
            EXPECT_TRUE(std::any_of(
                piece.cuts.begin(), piece.cuts.end(),
                [](const Contour& cut) { return cut.closed && has_narrow_place(cut.points, 0.2); }))
                << seed << ": " << result.found[0].message;
        }
    }
    EXPECT_GT(pieces, 200);
    EXPECT_LE(refused, pieces / 100);
}

}  // namespace
}  // namespace popup
