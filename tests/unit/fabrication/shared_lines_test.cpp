// Lines that lie on others: what is left is measured against a grid of edges that this test counts itself,
// and by points along everything that was put in.
#include "fabrication/shared_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "support/random.h"
#include "support/sheet_example.h"

namespace popup {
namespace {

using test::Random;
using test::rectangle;

struct Path {
    std::vector<Vec2> points;
    bool closed = false;
};

std::vector<Segment> segments_of(const std::vector<Vec2>& points, bool closed) {
    std::vector<Segment> all;
    for (std::size_t i = 1; i < points.size(); ++i) all.push_back({points[i - 1], points[i]});
    if (closed) all.push_back({points.back(), points.front()});
    return all;
}

double length_of(const std::vector<Segment>& segments) {
    double sum = 0.0;
    for (const Segment& one : segments) sum += distance(one.a, one.b);
    return sum;
}

// What is left of all paths, put in one after the other.
struct Left {
    std::vector<std::vector<PathPart>> of;  // each path
    std::vector<Segment> segments;          // of all of them
};

Left left_of_all(const std::vector<Path>& paths) {
    Left left;
    SharedLines lines;
    for (const Path& path : paths) {
        left.of.push_back(lines.left_of(path.points, path.closed));
        for (const PathPart& part : left.of.back()) {
            EXPECT_GE(part.points.size(), 2U);
            const std::vector<Segment> segments = segments_of(part.points, part.closed);
            left.segments.insert(left.segments.end(), segments.begin(), segments.end());
        }
    }
    return left;
}

double nearest(const std::vector<Segment>& segments, Vec2 p) {
    double least = HUGE_VAL;
    for (const Segment& one : segments) least = std::min(least, distance(p, one));
    return least;
}

// The largest distance of points along `from` from `to`.
double furthest(const std::vector<Segment>& from, const std::vector<Segment>& to) {
    double most = 0.0;
    for (const Segment& one : from) {
        const int steps = 1 + static_cast<int>(distance(one.a, one.b) / 0.31);
        for (int i = 0; i <= steps; ++i)
            most = std::max(most, nearest(to, lerp(one.a, one.b, static_cast<double>(i) / steps)));
    }
    return most;
}

// Nothing lost, and nothing made up.
void expect_same_lines(const std::vector<Path>& paths, const Left& left, double tolerance_mm) {
    std::vector<Segment> all;
    for (const Path& path : paths) {
        const std::vector<Segment> segments = segments_of(path.points, path.closed);
        all.insert(all.end(), segments.begin(), segments.end());
    }
    EXPECT_LE(furthest(all, left.segments), tolerance_mm);
    EXPECT_LE(furthest(left.segments, all), 1e-9);
}

std::vector<Vec2> carried(const std::vector<Vec2>& points, double angle, Vec2 by) {
    std::vector<Vec2> all;
    all.reserve(points.size());
    for (const Vec2 p : points) all.push_back(rotated(p, angle) + by);
    return all;
}

Path square(double left, double low, double right, double high) {
    return {rectangle(left, low, right, high), true};
}

TEST(SharedLines, ALineThatRunsBackOnItselfIsCutOnce) {
    const Left back = left_of_all({{{{0, 0}, {30, 0}, {10, 0}}, false}});
    EXPECT_NEAR(length_of(back.segments), 30.0, 1e-9);
    // Past where it began.
    const Left past = left_of_all({{{{0, 0}, {30, 0}, {-10, 0}}, false}});
    EXPECT_NEAR(length_of(past.segments), 40.0, 1e-9);
    const Left closed = left_of_all({{{{0, 0}, {30, 0}}, true}});
    EXPECT_NEAR(length_of(closed.segments), 30.0, 1e-9);
    // A square with a hair on it.
    const Left hair = left_of_all({{{{0, 0}, {10, 0}, {10, 5}, {25, 5}, {10, 5}, {10, 10}, {0, 10}}, true}});
    EXPECT_NEAR(length_of(hair.segments), 55.0, 1e-9);
}

TEST(SharedLines, LeavesAPathThatLiesOnNoneAsItIs) {
    const std::vector<Path> paths{square(0, 0, 10, 10),
                                  square(10.02, 0, 20, 10),        // as near as two lines may be
                                  {{{-5, 20}, {5, 20}, {9, 30}}},  // open
                                  {{{1, 1}}}};                     // no line at all
    SharedLines lines;
    for (const Path& path : paths) {
        const std::vector<PathPart> parts = lines.left_of(path.points, path.closed);
        ASSERT_EQ(parts.size(), 1U);
        EXPECT_EQ(parts[0].points, path.points);
        EXPECT_EQ(parts[0].closed, path.closed);
    }
}

TEST(SharedLines, GivesTwoSquaresSideBySideTheirEdgeOnce) {
    for (const double gap : {0.0, 0.005, -0.005, 0.009}) {
        SCOPED_TRACE(gap);
        const std::vector<Path> paths{square(0, 0, 10, 10), square(10 + gap, 0, 20, 10)};
        const Left left = left_of_all(paths);
        EXPECT_TRUE(left.of[0][0].closed);
        ASSERT_EQ(left.of[1].size(), 1U);
        const PathPart& open = left.of[1][0];
        EXPECT_FALSE(open.closed);
        // Round the other three sides, in the square's order.
        EXPECT_EQ(open.points, (std::vector<Vec2>{{10 + gap, 0}, {20, 0}, {20, 10}, {10 + gap, 10}}));
        expect_same_lines(paths, left, kSharedMm);
    }
}

TEST(SharedLines, GivesTheEdgeOnceWhereverASquareBegins) {
    for (std::size_t first = 0; first < 4; ++first) {
        for (const bool clockwise : {false, true}) {
            Path second = square(10, 0, 20, 10);
            if (clockwise) std::reverse(second.points.begin(), second.points.end());
            std::rotate(second.points.begin(), second.points.begin() + static_cast<std::ptrdiff_t>(first),
                        second.points.end());
            const Left left = left_of_all({square(0, 0, 10, 10), second});
            ASSERT_EQ(left.of[1].size(), 1U) << "one line round three sides";
            EXPECT_EQ(left.of[1][0].points.size(), 4U);
            EXPECT_NEAR(length_of(left.segments), 70.0, 1e-9);
        }
    }
}

TEST(SharedLines, TakesAwayOnlyThePartOfAnEdgeThatIsShared) {
    const std::vector<Path> paths{square(0, 0, 10, 10), square(10, 4, 20, 14), square(10, -20, 12, 1)};
    const Left left = left_of_all(paths);
    EXPECT_NEAR(length_of(segments_of(left.of[1][0].points, false)), 34.0, 1e-9);
    EXPECT_NEAR(length_of(left.segments), 40.0 + 34.0 + 45.0, 1e-9);
    expect_same_lines(paths, left, 1e-9);
}

TEST(SharedLines, LeavesBothEndsOfAnEdgeWhoseMiddleIsShared) {
    const std::vector<Path> paths{square(0, 4, 10, 6), square(10, 0, 20, 10)};
    const Left left = left_of_all(paths);
    // The contour goes on round its first corner: one line, from one end of what is shared to the other.
    ASSERT_EQ(left.of[1].size(), 1U);
    EXPECT_EQ(left.of[1][0].points.front(), (Vec2{10, 4}));
    EXPECT_EQ(left.of[1][0].points.back(), (Vec2{10, 6}));
    EXPECT_NEAR(length_of(left.segments), 24.0 + 38.0, 1e-9);
    expect_same_lines(paths, left, 1e-9);
}

TEST(SharedLines, GivesThreeInARowEachEdgeOnce) {
    const std::vector<Path> paths{square(0, 0, 10, 10), square(20, 0, 30, 10), square(10, 0, 20, 10)};
    const Left left = left_of_all(paths);
    EXPECT_EQ(left.of[1].size(), 1U);
    EXPECT_TRUE(left.of[1][0].closed);
    // Of the one in the middle its lower and its upper side are left.
    ASSERT_EQ(left.of[2].size(), 2U);
    EXPECT_EQ(left.of[2][0].points, (std::vector<Vec2>{{10, 0}, {20, 0}}));
    EXPECT_EQ(left.of[2][1].points, (std::vector<Vec2>{{20, 10}, {10, 10}}));
    expect_same_lines(paths, left, 1e-9);
}

TEST(SharedLines, GivesNothingOfAPathThatLiesOnAnother) {
    SharedLines lines;
    static_cast<void>(lines.left_of(rectangle(0, 0, 10, 10), true));
    EXPECT_TRUE(lines.left_of(rectangle(0, 0, 10, 10), true).empty());
    EXPECT_TRUE(lines.left_of(std::vector<Vec2>{{0, 7}, {0, 0}, {5, 0}}, false).empty());
    EXPECT_TRUE(lines.left_of(std::vector<Vec2>{{3, 10.005}, {7, 10.005}}, false).empty());
    // In small steps, each shorter than the tolerance.
    std::vector<Vec2> steps;
    for (int i = 0; i <= 400; ++i) steps.push_back({2.0 + 0.009 * i, 0.003 * (i % 2)});
    EXPECT_TRUE(lines.left_of(steps, false).empty());
    // On the edges of several.
    static_cast<void>(lines.left_of(rectangle(10, 0, 20, 10), true));
    EXPECT_TRUE(lines.left_of(std::vector<Vec2>{{1, 10}, {19, 10}}, false).empty());
}

TEST(SharedLines, LeavesLinesThatOnlyCrossOrTouch) {
    Random random(11);
    SharedLines lines;
    double whole = 0.0;
    double left = 0.0;
    for (int i = 0; i < 200; ++i) {
        const std::vector<Vec2> path{{100 * random.unit(), 100 * random.unit()},
                                     {100 * random.unit(), 100 * random.unit()}};
        const std::vector<PathPart> parts = lines.left_of(path, false);
        ASSERT_EQ(parts.size(), 1U);
        EXPECT_EQ(parts[0].points, path);
        whole += distance(path[0], path[1]);
        for (const Segment& one : segments_of(parts[0].points, false)) left += distance(one.a, one.b);
        // From its middle, square to it.
        const Vec2 middle = lerp(path[0], path[1], 0.5);
        const std::vector<Vec2> branch{middle, middle + 3.0 * left_of(unit(path[1] - path[0]))};
        ASSERT_EQ(lines.left_of(branch, false).size(), 1U);
    }
    EXPECT_EQ(left, whole);
}

// Rectangles on a grid of 10 mm: each edge of the grid that any of them has, once.
struct Grid {
    std::vector<Path> paths;
    std::size_t edges = 0;  // of the grid, each counted once
    std::size_t drawn = 0;  // each as often as it is drawn
};

Grid random_grid(std::uint64_t seed, double angle, double off_mm) {
    Random random(seed);
    Grid grid;
    std::set<std::pair<std::pair<int, int>, bool>> edges;  // from where, and whether upwards
    for (int k = 0; k < 25; ++k) {
        const int left = static_cast<int>(random.below(7));
        const int low = static_cast<int>(random.below(7));
        const int right = left + 1 + static_cast<int>(random.below(4));
        const int high = low + 1 + static_cast<int>(random.below(4));
        for (int x = left; x < right; ++x) {
            for (const int y : {low, high}) edges.insert({{x, y}, false});
        }
        for (int y = low; y < high; ++y) {
            for (const int x : {left, right}) edges.insert({{x, y}, true});
        }
        grid.drawn += 2U * static_cast<std::size_t>(right - left + high - low);
        std::vector<Vec2> corners = rectangle(10.0 * left, 10.0 * low, 10.0 * right, 10.0 * high);
        if (random.below(2) == 0) std::reverse(corners.begin(), corners.end());
        std::rotate(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(random.below(4)),
                    corners.end());
        const double way = 6.28 * random.unit();
        grid.paths.push_back(
            {carried(corners, angle, Vec2{37.1, -12.7} + off_mm * Vec2{std::cos(way), std::sin(way)}), true});
    }
    grid.edges = edges.size();
    return grid;
}

TEST(SharedLines, LeavesTheUnionOfRectanglesOnAGrid) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(seed);
        const Grid grid = random_grid(seed, 0.0, 0.0);
        const Left left = left_of_all(grid.paths);
        ASSERT_LT(grid.edges, grid.drawn);
        EXPECT_NEAR(length_of(left.segments), 10.0 * static_cast<double>(grid.edges), 1e-6);
        expect_same_lines(grid.paths, left, 1e-9);
    }
}

TEST(SharedLines, LeavesTheUnionHoweverItIsTurnedAndALittleMoved) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        SCOPED_TRACE(seed);
        // All lines that ought to be one are within a hundredth of each other.
        constexpr double kOff = 0.0035;
        const Grid grid = random_grid(seed, 0.1 + 0.37 * static_cast<double>(seed), kOff);
        const Left left = left_of_all(grid.paths);
        // At each of its two ends an edge may be longer or shorter by what the others are off.
        EXPECT_NEAR(length_of(left.segments), 10.0 * static_cast<double>(grid.edges),
                    4.0 * kOff * static_cast<double>(grid.edges));
        expect_same_lines(grid.paths, left, kSharedMm);
    }
}

// Each is near enough to the next to be one with it, but what was taken away takes nothing away itself.
TEST(SharedLines, OfManyCloseLinesNoneIsFarFromOneThatIsLeft) {
    std::vector<Path> paths;
    for (int i = 0; i < 100; ++i) paths.push_back({{{0.0, 0.009 * i}, {50.0, 0.009 * i}}, false});
    const Left left = left_of_all(paths);
    EXPECT_EQ(left.segments.size(), 50U);
    expect_same_lines(paths, left, kSharedMm);
}

}  // namespace
}  // namespace popup
