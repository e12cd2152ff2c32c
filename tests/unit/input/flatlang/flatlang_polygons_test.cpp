// Which loops of a trail are polygons, and what the original interpreter wrote of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "input/flatlang/turtle/original_files.h"
#include "input/flatlang/turtle/polygons.h"
#include "input/flatlang/turtle/poses.h"
#include "input/flatlang/turtle/turtle.h"

namespace popup::flatlang {
namespace {

constexpr std::uint64_t plenty = 1'000'000;

bool same_place(Vec3 a, Vec3 b) {
    return std::fabs(a.x - b.x) < 1e-4 && std::fabs(a.y - b.y) < 1e-4 && std::fabs(a.z - b.z) < 1e-4;
}

// The rule as it is written, with a look at every point.
class NaiveFinder {
 public:
    void lift() { run_.clear(); }
    void add(Vec3 point) {
        if (!run_.empty() && same_place(run_.back(), point)) return;
        run_.push_back(point);
        std::size_t oldest = 0;
        while (!same_place(run_[oldest], point)) ++oldest;
        if (oldest + 1 == run_.size()) return;
        const std::vector<Vec3> loop(run_.rbegin() + 1, run_.rend() - static_cast<std::ptrdiff_t>(oldest));
        if (loop.size() < 3) return;
        const Vec3 normal = cross(loop[1] - loop[0], loop[2] - loop[0]);
        const double size = length(normal);
        for (std::size_t i = 3; i < loop.size(); ++i) {
            if (size > 0 && std::fabs(dot(normal, loop[i] - loop[0])) / size >= 1e-4) return;
        }
        found.push_back(loop);
        run_.resize(oldest);
        run_.push_back(point);
    }
    std::vector<std::vector<Vec3>> found;

 private:
    std::vector<Vec3> run_;
};

TEST(FlatlangPolygons, AreThoseOfTheRuleOnAnyWalk) {
    for (unsigned seed = 1; seed <= 60; ++seed) {
        std::mt19937 random(seed);
        PolygonFinder finder;
        NaiveFinder naive;
        std::vector<std::vector<Vec3>> found;
        // Few places on some, many on others.
        const int wide = 1 + static_cast<int>(seed % 6);
        Vec3 at{};
        for (int i = 0; i < 2000; ++i) {
            double& axis = std::array<double*, 3>{&at.x, &at.y, &at.z}[random() % (seed % 4 == 0 ? 3 : 2)][0];
            axis += random() % 2 == 0 ? 0.25 : -0.25;
            axis = std::clamp(axis, -0.25 * wide, 0.25 * wide);
            if (random() % 200 == 0) {
                finder.lift();
                naive.lift();
            }
            naive.add(at);
            if (finder.add(at)) found.push_back(finder.polygon());
        }
        ASSERT_EQ(found, naive.found) << seed;
    }
}

Vec3 placed(const Pose& plane, Vec2 p) { return plane.at + p.x * plane.right + p.y * plane.heading; }

Pose random_plane(std::mt19937& random) {
    Pose plane;
    for (const Axis axis : {Axis::up, Axis::right, Axis::heading}) {
        turn(plane, axis, static_cast<double>(random() % 3600) / 10);
        move(plane, static_cast<double>(random() % 100) / 10);
    }
    return plane;
}

TEST(FlatlangPolygons, AClosedLoopInAnyPlaneIsFoundWithItsPoints) {
    for (unsigned seed = 1; seed <= 200; ++seed) {
        std::mt19937 random(seed);
        const Pose plane = random_plane(random);
        // A star about its middle, of which some sides are straight on for several points.
        std::vector<Vec3> loop;
        const int corners = 3 + static_cast<int>(random() % 8);
        for (int i = 0; i < corners; ++i) {
            const double angle = 2 * std::numbers::pi * i / corners;
            const double radius = 1 + static_cast<double>(random() % 100) / 50;
            const Vec2 corner{radius * std::cos(angle), radius * std::sin(angle)};
            if (i > 0 && i < corners - 2 && random() % 2 == 0) {
                loop.push_back(0.5 * (loop.back() + placed(plane, corner)));
            }
            loop.push_back(placed(plane, corner));
        }
        PolygonFinder closed;
        for (const Vec3 point : loop) EXPECT_FALSE(closed.add(point));
        // It misses its beginning by a little.
        ASSERT_TRUE(closed.add(loop.front() + Vec3{9e-5, -9e-5, 9e-5})) << seed;
        EXPECT_EQ(closed.polygon(), std::vector<Vec3>(loop.rbegin(), loop.rend()));
        // By more; and with a point off the plane.
        PolygonFinder open;
        for (const Vec3 point : loop) open.add(point);
        EXPECT_FALSE(open.add(loop.front() + Vec3{1.1e-4, 0, 0}));
        if (corners == 3) continue;
        std::vector<Vec3> askew = loop;
        const std::size_t off = random() % askew.size();
        askew[off] = askew[off] + 0.01 * plane.up;
        PolygonFinder finder;
        for (const Vec3 point : askew) finder.add(point);
        EXPECT_FALSE(finder.add(askew.front())) << seed;
    }
}

std::vector<std::vector<Vec3>> found(const std::vector<Vec3>& points) {
    PolygonFinder finder;
    std::vector<std::vector<Vec3>> loops;
    for (const Vec3 point : points) {
        if (finder.add(point)) loops.push_back(finder.polygon());
    }
    return loops;
}

TEST(FlatlangPolygons, ThreePointsOnALineHaveNoPlane) {
    const Vec3 o{0, 0, 0};
    const Vec3 a{1, 0, 0};
    const Vec3 b{2, 0, 0};
    EXPECT_EQ(found({o, {0, 2, 0}, {1, 2, 1}, {3, 0, 0}, b, a, o}).size(), 1U);
    // So ways there and back are loops, and leave the run to what comes after.
    const Vec3 c{2, 1, 0};
    const Vec3 d{0, 1, 0};
    EXPECT_EQ(found({o, a, b, a, o, d, c, b, o}),
              (std::vector<std::vector<Vec3>>{{a, b, a, o}, {b, c, d, o}}));
}

TEST(FlatlangPolygons, WhatIsNotFiniteIsPassedOver) {
    const double infinite = HUGE_VAL;
    EXPECT_EQ(found({{0, 0, 0}, {1, 0, 0}, {infinite, 0, 0}, {NAN, NAN, 0}, {1, 1, 0}, {0, 0, 0}}).size(),
              1U);
    // Neighbouring numbers are further apart there than the tolerance.
    EXPECT_EQ(found({{0, 0, 0}, {1e30, 0, 0}, {1e30, 1e30, 0}, {0, 0, 0}}).size(), 1U);
}

TEST(FlatlangPolygons, ManyPointsTakeNotLongWhateverTheyDo) {
    constexpr int many = 100'000;
    const auto count = [](auto place) {
        PolygonFinder finder;
        int loops = 0;
        for (int i = 0; i < many; ++i) loops += finder.add(place(i)) ? 1 : 0;
        return loops;
    };
    // To and fro.
    EXPECT_GE(count([](int i) { return Vec3{static_cast<double>(i % 2), 0, 0}; }), 0);
    // Out from one place into all directions of space and back.
    const auto star = [](int i) {
        return i % 2 == 0 ? Vec3{} : Vec3{std::cos(i), std::sin(i), std::sin(0.1 * i)};
    };
    EXPECT_GE(count(star), 0);
    // The same in a plane, after points that are off it.
    const auto flat_star = [](int i) {
        constexpr std::array<Vec3, 4> first{{{}, {1, 0, 1}, {0, 1, 2}, {1, 1, 0}}};
        if (i < 4) return first[static_cast<std::size_t>(i)];
        return i % 2 == 0 ? Vec3{} : Vec3{std::cos(i), std::sin(i), 0};
    };
    EXPECT_GE(count(flat_star), 0);
    // Squares side by side that do not close, and one long line.
    const auto steps = [](int i) {
        return Vec3{i / 4 + (i % 4 == 1 || i % 4 == 2 ? 0.5 : 0.0), i % 4 >= 2 ? 0.5 : 0.0, 0};
    };
    EXPECT_EQ(count(steps), 0);
    EXPECT_EQ(count([](int i) { return Vec3{i * 0.001, 0, 0}; }), 0);
}

// Empty when all numbers agree within a unit, which is what truncation leaves open; else the line that does
// not.
std::string near_units(const std::string& made, const std::string& wanted) {
    std::istringstream a(made);
    std::istringstream b(wanted);
    std::string x;
    std::string y;
    while (true) {
        const bool more = static_cast<bool>(std::getline(a, x));
        if (more != static_cast<bool>(std::getline(b, y))) return "one is longer";
        if (!more) return "";
        std::istringstream words_a(x);
        std::istringstream words_b(y);
        std::string pen_a;
        std::string pen_b;
        words_a >> pen_a;
        words_b >> pen_b;
        if (pen_a != pen_b) return x + " but " + y;
        int number_a = 0;
        int number_b = 0;
        while (words_a >> number_a && words_b >> number_b) {
            if (std::abs(number_a - number_b) > 1) return x + " but " + y;
        }
    }
}

// Of a regular polygon, to the left or, with a negative count, to the right.
void corners(Turtle& turtle, int count, double side) {
    for (int i = 0; i < std::abs(count); ++i) {
        turtle.forward(side);
        turtle.left(360.0 / count);
    }
}

TEST(FlatlangOriginalFiles, PolygonsLieOnShelvesOrOnTopOfEachOther) {
    Turtle layout(true, plenty);
    corners(layout, 4, 5);
    corners(layout, -3, 4);
    layout.roll(90);
    corners(layout, 4, 6);
    layout.pitch(30);
    corners(layout, -3, 3);
    corners(layout, 4, 2);
    Turtle on_a_line(true, plenty);
    for (const double side : {2.0, 2.0, 2.0}) {
        on_a_line.forward(side);
        on_a_line.left(90);
    }
    for (const double side : {0.5, 0.5, 1.0}) on_a_line.forward(side);
    EXPECT_EQ(original_hpgl(Trail{}, false), "IN\nPA\nSP3\n\n");
    EXPECT_EQ(near_units(original_hpgl(layout.trail(), false),
                         "IN\n"
                         "PA\n"
                         "SP3\n"
                         "\n"
                         "PU 0 0\n"
                         "PD 5080 0\n"
                         "PD 5080 5080\n"
                         "PD 0 5080\n"
                         "PD 0 0\n"
                         "PU 5181 0\n"
                         "PD 9245 0\n"
                         "PD 7213 3519\n"
                         "PD 5181 0\n"
                         "PU 0 5181\n"
                         "PD 6095 5181\n"
                         "PD 6095 11277\n"
                         "PD 0 11277\n"
                         "PD 0 5181\n"
                         "PU 6197 5181\n"
                         "PD 9245 5181\n"
                         "PD 7721 7821\n"
                         "PD 6197 5181\n"
                         "PU 9347 5181\n"
                         "PD 11379 5181\n"
                         "PD 11379 7213\n"
                         "PD 9347 7213\n"
                         "PD 9347 5181\n"
                         "PU 9347 5181\n"),
              "");
    Turtle with_hole(true, plenty);
    corners(with_hole, 4, 5);
    with_hole.pen(false);
    with_hole.forward(1);
    with_hole.left(90);
    with_hole.forward(-1);
    with_hole.left(-90);
    with_hole.pen(true);
    corners(with_hole, 4, 2);
    const Trail hole = with_hole.trail();
    EXPECT_EQ(near_units(original_hpgl(hole, true),
                         "IN\n"
                         "PA\n"
                         "SP3\n"
                         "\n"
                         "PU 0 0\n"
                         "PD 5080 0\n"
                         "PD 5080 5080\n"
                         "PD 0 5080\n"
                         "PD 0 0\n"
                         "PU 1015 4064\n"
                         "PD 3047 4064\n"
                         "PD 3048 6096\n"
                         "PD 1016 6096\n"
                         "PD 1015 4064\n"
                         "PU 1015 4064\n"),
              "");
    // Three points on a line: all of it is one.
    EXPECT_EQ(near_units(original_hpgl(on_a_line.trail(), false),
                         "IN\n"
                         "PA\n"
                         "SP3\n"
                         "\n"
                         "PU 1016 0\n"
                         "PD 1524 0\n"
                         "PD 2032 0\n"
                         "PD 2032 0\n"
                         "PD 0 0\n"
                         "PD 0 0\n"
                         "PD 1016 0\n"
                         "PU 1016 0\n"),
              "");
    const OriginalLaser laser = original_laser(hole, true);
    EXPECT_NEAR(laser.width, 370, 1);
    EXPECT_NEAR(laser.height, 442, 1);
    ASSERT_EQ(laser.lines.size(), 8U);
    EXPECT_LT(distance(laser.lines[0].a, Vec2{2, 2}), 1e-6);
    EXPECT_LT(distance(laser.lines[0].b, Vec2{362, 2}), 1e-6);
    EXPECT_LT(distance(laser.lines[7].a, Vec2{74, 434}), 1e-6);
    EXPECT_LT(distance(laser.lines[7].b, Vec2{74, 290}), 1e-6);
    // Its shelves are in points: the first polygon does not fit onto the first.
    EXPECT_LT(distance(original_laser(hole, false).lines[0].a, Vec2{2, 2.1}), 1e-6);
}

}  // namespace
}  // namespace popup::flatlang
