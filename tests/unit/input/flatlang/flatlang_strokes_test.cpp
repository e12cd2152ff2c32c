// Outlines that a turtle draws in several strokes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "input/flatlang/pieces/pieces.h"
#include "input/flatlang/pieces/strokes.h"
#include "support/random.h"

namespace popup::flatlang {
namespace {

std::vector<std::size_t> all_of(const Trail& trail) {
    std::vector<std::size_t> numbers(trail.segments.size());
    std::iota(numbers.begin(), numbers.end(), std::size_t{0});
    return numbers;
}

Trail trail_of(std::vector<TrailSegment> segments) {
    Trail trail;
    trail.parts = {{"", {}}, {"a", {}}, {"b", {}}};
    trail.segments = std::move(segments);
    return trail;
}

double between(popup::test::Random& random, double low, double high) {
    return low + (high - low) * random.unit();
}

// A star of `n` corners in a plane of its own, its sides drawn in any order and direction.
std::vector<TrailSegment> scattered_star(int n, popup::test::Random& random, double gap) {
    const Vec3 u = unit(Vec3{between(random, -1, 1), between(random, -1, 1), 1.5});
    const Vec3 v = unit(cross(u, Vec3{1, 0, 0}));
    std::vector<Vec3> corners;
    for (int i = 0; i < n; ++i) {
        const double angle = 2.0 * M_PI * i / n;
        const double radius = between(random, 1.0, 2.0);
        corners.push_back(Vec3{5, 5, 5} + radius * std::cos(angle) * u + radius * std::sin(angle) * v);
    }
    std::vector<TrailSegment> sides;
    for (int i = 0; i < n; ++i) {
        const Vec3 a = corners[static_cast<std::size_t>(i)];
        Vec3 b = corners[static_cast<std::size_t>((i + 1) % n)];
        if (i == 0) b = b + gap * u;
        sides.push_back(random.below(2) == 0 ? TrailSegment{a, b, 1} : TrailSegment{b, a, 1});
    }
    for (std::size_t i = sides.size(); i > 1; --i) std::swap(sides[i - 1], sides[random.below(i)]);
    return sides;
}

double area_of(const std::vector<Vec3>& points) {
    Vec3 swept{};
    for (std::size_t i = 0; i < points.size(); ++i)
        swept = swept + cross(points[i], points[(i + 1) % points.size()]);
    return 0.5 * length(swept);
}

TEST(FlatLangStrokes, LoopsAreFoundWhateverOrderTheirSidesAreDrawnIn) {
    popup::test::Random random(7);
    for (int round = 0; round < 200; ++round) {
        const int n = 3 + static_cast<int>(random.below(30));
        const Trail trail = trail_of(scattered_star(n, random, 5e-5));
        const auto loops = loops_of_strokes(trail, all_of(trail));
        ASSERT_EQ(loops.size(), 1U) << round;
        EXPECT_EQ(loops[0].points.size(), static_cast<std::size_t>(n));
        EXPECT_EQ(loops[0].part, 1);
        EXPECT_GT(area_of(loops[0].points), 0.5);
    }
}

TEST(FlatLangStrokes, AGapOrACrossingKeepsALoopOpen) {
    popup::test::Random random(8);
    for (int round = 0; round < 50; ++round) {
        const Trail trail = trail_of(scattered_star(4 + static_cast<int>(random.below(9)), random, 5e-4));
        EXPECT_TRUE(loops_of_strokes(trail, all_of(trail)).empty());
    }
    // Two triangles that share a corner: which side goes on with which cannot be told.
    const Vec3 o{0, 0, 0}, a{1, 0, 0}, b{0, 1, 0}, c{-1, 0, 0}, d{0, -1, 0};
    const Trail bow = trail_of({{o, a, 0}, {a, b, 0}, {b, o, 0}, {o, c, 0}, {c, d, 0}, {d, o, 0}});
    EXPECT_TRUE(loops_of_strokes(bow, all_of(bow)).empty());
}

TEST(FlatLangStrokes, SidesOfDifferentPartsOrPlanesCloseNothing) {
    const Vec3 o{0, 0, 0}, a{1, 0, 0}, b{1, 1, 0}, c{0, 1, 0.01};
    const Trail askew = trail_of({{o, a, 1}, {a, b, 1}, {b, c, 1}, {c, o, 1}});
    EXPECT_TRUE(loops_of_strokes(askew, all_of(askew)).empty());
    const Trail mixed = trail_of({{o, a, 1}, {a, b, 1}, {b, o, 2}});
    EXPECT_TRUE(loops_of_strokes(mixed, all_of(mixed)).empty());
    const Trail line = trail_of({{o, a, 1}, {a, o, 1}, {o, a, 1}});
    EXPECT_TRUE(loops_of_strokes(line, all_of(line)).empty());
}

TEST(FlatLangStrokes, WhatStrokesCloseIsAPart) {
    popup::test::Random random(9);
    Diagnostics diagnostics("strokes.fl");
    const auto list = make_parts(trail_of(scattered_star(12, random, 0.0)), diagnostics);
    ASSERT_TRUE(list);
    ASSERT_EQ(list->parts.size(), 1U);
    EXPECT_EQ(list->parts[0].name, "a");
    EXPECT_EQ(list->parts[0].paper.at(0).outer.size(), 12U);
    EXPECT_TRUE(diagnostics.sorted().empty());
}

}  // namespace
}  // namespace popup::flatlang
