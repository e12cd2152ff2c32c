// Joints hold each piece in its sheet: at least two, on straight stretches, clear of corners and folds, and
// nothing else of the cut is lost.
#include "fabrication/joints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace popup {
namespace {

double length_of(const PathPart& part) {
    double sum = 0.0;
    for (std::size_t i = 1; i < part.points.size(); ++i) sum += distance(part.points[i - 1], part.points[i]);
    if (part.closed) sum += distance(part.points.back(), part.points.front());
    return sum;
}

double length_of(const std::vector<PathPart>& parts) {
    double sum = 0.0;
    for (const PathPart& part : parts) sum += length_of(part);
    return sum;
}

// The middles of the gaps of a closed path: each part begins where a gap ends.
std::vector<Vec2> gaps_of(const std::vector<PathPart>& parts) {
    std::vector<Vec2> middles;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Vec2 end = parts[i].points.back();
        const Vec2 next = parts[(i + 1) % parts.size()].points.front();
        middles.push_back(lerp(end, next, 0.5));
    }
    return middles;
}

TEST(Joints, LieOnStraightStretchesClearOfCornersAndFolds) {
    const Ring ring{{0, 0}, {80, 0}, {80, 50}, {60, 70}, {0, 50}};
    const std::vector<Segment> lines{{{40, 0}, {40, 60}}, {{0, 25}, {80, 25}}};
    const EdgeIndex folds({}, lines);
    const std::vector<OuterCut> cuts{{ring, true}};
    const JointedCuts made = with_joints(cuts, 0.4, folds);
    ASSERT_EQ(made.parts.size(), 1U);
    EXPECT_EQ(made.joints, 2U);  // of 265 mm
    ASSERT_EQ(made.parts[0].size(), made.joints);
    const double whole = length_of(PathPart{ring, true});
    EXPECT_NEAR(length_of(made.parts[0]), whole - 0.4 * static_cast<double>(made.joints), 1e-6);
    for (const Vec2 gap : gaps_of(made.parts[0])) {
        for (const Vec2 corner : ring) EXPECT_GE(distance(gap, corner), 5.0);
        for (const Segment& line : lines) EXPECT_GE(distance(gap, line), 5.0);
        double nearest = 1e9;
        for (std::size_t i = 0; i < ring.size(); ++i)
            nearest = std::min(nearest, distance(gap, Segment{ring[i], ring[(i + 1) % ring.size()]}));
        EXPECT_LE(nearest, 1e-6);
    }
}

TEST(Joints, AreMoreOnLongerCutsAndTwoOnTheSmallest) {
    const EdgeIndex none;
    for (const double side : {4.0, 10.0, 37.5, 100.0, 300.0}) {
        const Ring ring{{0, 0}, {side, 0}, {side, side}, {0, side}};
        const std::vector<OuterCut> cuts{{ring, true}};
        const JointedCuts made = with_joints(cuts, 0.4, none);
        EXPECT_EQ(made.joints, static_cast<std::size_t>(std::max(2L, std::lround(4.0 * side / 150.0))))
            << side;
        for (const PathPart& part : made.parts[0]) EXPECT_FALSE(part.closed);
    }
}

// A circle is nowhere straight, but hardly bent over a gap.
TEST(Joints, LieOnGentleCurves) {
    Ring ring;
    for (int i = 0; i < 400; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / 400;
        ring.push_back(20.0 * Vec2{std::cos(angle), std::sin(angle)});
    }
    const std::vector<OuterCut> cuts{{ring, true}};
    const JointedCuts made = with_joints(cuts, 0.4, EdgeIndex());
    EXPECT_EQ(made.joints, 2U);
    EXPECT_NEAR(length_of(made.parts[0]), length_of(PathPart{ring, true}) - 0.8, 1e-6);
}

// What neighbours share is drawn once: the rest of a piece's edge is open, and its ends are no place either.
TEST(Joints, KeepClearOfTheEndsOfOpenPaths) {
    const std::vector<Vec2> path{{0, 0}, {60, 0}, {60, 30}};
    const std::vector<OuterCut> cuts{{path, false}};
    const JointedCuts made = with_joints(cuts, 0.5, EdgeIndex());
    EXPECT_EQ(made.joints, 2U);
    ASSERT_EQ(made.parts[0].size(), 3U);
    EXPECT_NEAR(length_of(made.parts[0]), 89.0, 1e-6);
    EXPECT_EQ(made.parts[0].front().points.front(), path.front());
    EXPECT_EQ(made.parts[0].back().points.back(), path.back());
    for (std::size_t i = 0; i + 1 < made.parts[0].size(); ++i) {
        const Vec2 gap = made.parts[0][i].points.back();
        for (const Vec2 corner : path) EXPECT_GE(distance(gap, corner), 4.0);
    }
}

TEST(Joints, AreNotForcedWhereThereIsNoPlace) {
    const Ring tiny{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const std::vector<OuterCut> cuts{{tiny, true}};
    const JointedCuts made = with_joints(cuts, 0.4, EdgeIndex());
    EXPECT_EQ(made.joints, 0U);
    ASSERT_EQ(made.parts[0].size(), 1U);
    EXPECT_TRUE(made.parts[0][0].closed);
    EXPECT_EQ(made.parts[0][0].points, tiny);
}

}  // namespace
}  // namespace popup
