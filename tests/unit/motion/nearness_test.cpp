// How far points get and whether plates are kept apart over a range, against the motion itself.
#include "motion/nearness.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "motion/crossing.h"
#include "popup/assembly.h"
#include "support/random.h"

namespace popup {
namespace {

using test::Random;

double between(Random& random, double from, double to) { return from + (to - from) * random.unit(); }

// The point turned about the line, by Rodrigues' formula.
Vec3 turned(Vec3 p, Vec3 at, Vec3 dir, double angle) {
    const Vec3 w = p - at;
    return at + std::cos(angle) * w + std::sin(angle) * cross(dir, w) +
           ((1.0 - std::cos(angle)) * dot(dir, w)) * dir;
}

Vec3 direction(Random& random, double most_upright) {
    const double turn = between(random, 0.0, 6.3);
    const double up = between(random, -most_upright, most_upright);
    const Vec3 dir{std::cos(turn), std::sin(turn), up};
    return (1.0 / length(dir)) * dir;
}

TEST(LevelStray, IsNoLessThanWhatTheTurnsDo) {
    Random random(5);
    for (int round = 0; round < 3000; ++round) {
        std::vector<Arm> arms(1 + random.below(4));
        const double high = round % 3 == 0 ? 0.0 : 10.0;
        const double upright = round % 2 == 0 ? 0.0 : 2.0;
        for (Arm& arm : arms) {
            arm.at = {between(random, -50, 50), between(random, -50, 50), between(random, -high, high)};
            arm.dir = direction(random, upright);
            arm.turn = between(random, 0.0, 0.5);
        }
        const Moves moves{arms, std::nullopt};
        const Vec3 point{between(random, -50, 50), between(random, -50, 50), between(random, -high, high)};
        const double most = level_stray(point, moves);
        for (int i = 0; i < 30; ++i) {
            Vec3 p = point;
            // Ends of the ranges are where most happens.
            for (const Arm& arm : arms)
                p = turned(p, arm.at, arm.dir,
                           arm.turn * (i < 10 ? (i % 2 == 0 ? 1.0 : -1.0) : between(random, -1, 1)));
            EXPECT_LE(std::hypot(p.x - point.x, p.y - point.y), most + 1e-9) << round;
        }
    }
}

// Of lines in the plane of the page only the second order is left.
TEST(LevelStray, IsOfSecondOrderOnTheOpenCard) {
    const std::array<Arm, 1> arms{Arm{{0, 0, 0}, {0, 1, 0}, 0.02}};
    const Moves moves{arms, std::nullopt};
    EXPECT_DOUBLE_EQ(stray(Vec3{30, 0, 0}, moves), 0.6);
    EXPECT_LE(level_stray(Vec3{30, 0, 0}, moves), 0.02 * 0.6 + 0.5 * 0.02 * 0.6 + 1e-12);
}

PlateShape rectangle(double x, double y, double width, double height) {
    Plate plate;
    plate.outline.outer = {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
    return plate_shape(plate);
}

// Two plates of one page whose edges touch, one of which turns about its far edge: its near edge rises, and
// goes away from the other by 0.0034 mm. The cores are 0.02 mm apart.
TEST(Nearness, PlatesBesideEachOtherAreClearWhereOneRisesALittle) {
    const PlateShape a = rectangle(-10, 0, 10, 20);
    const PlateShape b = rectangle(0, 0, 30, 20);
    PairPose pose{&a, &b, Frame{}, {}, {}};
    const std::array<Arm, 1> arms{Arm{{30, 0, 0}, {0, 1, 0}, 0.015}};
    pose.from_a = pose.from_b = {arms, std::nullopt};
    NearnessTest test;
    EXPECT_GT(stray(Vec3{0, 0, 0}, pose.from_b), 0.4);
    EXPECT_TRUE(test.clear(pose));
    // Turned by so much their edges may meet as far as the bound says: 30 mm * 0.1² / 2.
    const std::array<Arm, 1> wide{Arm{{30, 0, 0}, {0, 1, 0}, 0.1}};
    pose.from_a = pose.from_b = {wide, std::nullopt};
    EXPECT_FALSE(test.clear(pose));
}

// What is said to be clear crosses nowhere in the range; and much is clear, and much is not.
TEST(Nearness, WhatIsClearDoesNotCross) {
    Random random(17);
    NearnessTest test;
    CrossingTest crossing;
    int clear = 0;
    int crossed = 0;
    for (int round = 0; round < 3000; ++round) {
        const PlateShape a = rectangle(0, 0, between(random, 5, 30), between(random, 5, 30));
        const PlateShape b = rectangle(between(random, -30, 30), between(random, -30, 30),
                                       between(random, 5, 30), between(random, 5, 30));
        // b lies in the plane of a, nearly so or anyhow, and turns about a line of it or another.
        const double tilt = std::array{0.0, 0.02, 1.5}.at(random.below(3));
        const Vec3 at{between(random, -30, 30), between(random, -30, 30), tilt * between(random, -10, 10)};
        const Vec3 dir = direction(random, tilt);
        Frame b_in_a;
        const double turn = between(random, -tilt, tilt);
        const Vec3 about = direction(random, 0.0);
        for (Vec3& axis : b_in_a.axes) axis = turned(axis, {}, about, turn);
        b_in_a.origin = {0, 0, tilt * between(random, -1, 1)};
        const std::array<Arm, 1> arms{Arm{at, dir, between(random, 0.0, 0.2)}};
        PairPose pose{&a, &b, b_in_a, {arms, std::nullopt}, {arms, std::nullopt}};
        const bool is_clear = test.clear(pose);
        bool crosses = false;
        for (int i = -10; i <= 10; ++i) {
            const double angle = 0.1 * i * arms[0].turn;
            Frame moved;
            for (std::size_t k = 0; k < 3; ++k) moved.axes.at(k) = turned(b_in_a.axes.at(k), {}, dir, angle);
            moved.origin = turned(b_in_a.origin, at, dir, angle);
            const auto here = crossing(a, b, moved);
            crosses = crosses || (here && here->inside_mm > kTouchMm + 1e-6);
        }
        EXPECT_FALSE(is_clear && crosses) << round;
        clear += is_clear ? 1 : 0;
        crossed += crosses ? 1 : 0;
    }
    EXPECT_GT(clear, 500);
    EXPECT_GT(crossed, 300);
}

}  // namespace
}  // namespace popup
