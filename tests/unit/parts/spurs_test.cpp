// Closed lines that run out and back on themselves: slits in outlines.
#include "parts/spurs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "parts/joining.h"
#include "support/drawings.h"
#include "support/random.h"

namespace popup {
namespace {

using Lines = std::vector<std::vector<Vec2>>;

TEST(Spurs, RunFromTheTipToWhereTheWaysPart) {
    EXPECT_EQ(spurs_of({{0, 0}, {10, 0}, {10, 5}, {5, 5}, {5, 2}, {5, 5}, {0, 5}}),
              (Lines{{{5, 2}, {5, 5}}}));
    // The way back passes the base and goes on along the same line.
    EXPECT_EQ(spurs_of({{0, 0}, {10, 0}, {10, 5}, {12, 5}, {0, 5}}), (Lines{{{12, 5}, {10, 5}}}));
    EXPECT_TRUE(spurs_of({{0, 0}, {10, 0}, {10, 5}, {0, 5}}).empty());
}

TEST(Spurs, MayBeginAnywhereInTheRing) {
    std::vector<Vec2> ring{{0, 0}, {10, 0}, {10, 5}, {5, 5}, {5, 3}, {3, 3}, {5, 3}, {5, 5}, {0, 5}};
    for (std::size_t i = 0; i < ring.size(); ++i) {
        std::rotate(ring.begin(), ring.begin() + 1, ring.end());
        const Lines spurs = spurs_of(ring);
        ASSERT_EQ(spurs.size(), 1U) << i;
        EXPECT_EQ(spurs[0], (std::vector<Vec2>{{3, 3}, {5, 3}, {5, 5}})) << i;
    }
}

TEST(Spurs, OfManyBranchesAreOneLineEach) {
    const Lines spurs =
        spurs_of({{0, 0}, {10, 0}, {10, 9}, {5, 9}, {5, 5}, {3, 5}, {5, 5}, {7, 5}, {5, 5}, {5, 9}, {0, 9}});
    ASSERT_EQ(spurs.size(), 2U);
    EXPECT_EQ(spurs[0], (std::vector<Vec2>{{3, 5}, {5, 5}}));
    EXPECT_EQ(spurs[1], (std::vector<Vec2>{{7, 5}, {5, 5}, {5, 9}}));
}

TEST(Spurs, OfBridgesNotchesAndRoundingThereAreNone) {
    // An outline that goes to a hole, round it and back.
    EXPECT_TRUE(
        spurs_of({{0, 0}, {10, 0}, {10, 9}, {5, 9}, {5, 6}, {6, 4}, {4, 4}, {5, 6}, {5, 9}, {0, 9}}).empty());
    // A notch a fiftieth of a millimetre wide is an outline; one that is shorter than that is rounding.
    EXPECT_TRUE(spurs_of({{0, 0}, {10, 0}, {10, 9}, {5.01, 9}, {5, 6}, {4.99, 9}, {0, 9}}).empty());
    EXPECT_TRUE(spurs_of({{0, 0}, {10, 0}, {10, 9}, {5, 9}, {5, 8.99}, {5, 9}, {0, 9}}).empty());
}

// Grown on the outline of a star: each is found whole, wherever its two ways have corners.
TEST(Spurs, AreAllFound) {
    test::Random random(5);
    for (int round = 0; round < 200; ++round) {
        std::vector<Vec2> ring;
        std::vector<double> wanted;
        const int corners = 5 + round % 40;
        for (int i = 0; i < corners; ++i) {
            const double turn = 2.0 * std::numbers::pi * i / corners;
            const Vec2 out{std::cos(turn), std::sin(turn)};
            const Vec2 corner = (20.0 + 10.0 * random.unit()) * out;
            ring.push_back(corner);
            if (random.unit() < 0.5) continue;
            // Inwards, and at its end to one side; the way back is the same line with other corners on it.
            const Vec2 knee = corner - (1.0 + 8.0 * random.unit()) * out;
            const Vec2 tip = knee + (0.1 + random.unit()) * Vec2{-out.y, out.x};
            wanted.push_back(distance(corner, knee) + distance(knee, tip));
            if (random.unit() < 0.5) ring.push_back(lerp(corner, knee, random.unit()));
            ring.insert(ring.end(), {knee, tip});
            if (random.unit() < 0.5) ring.push_back(lerp(tip, knee, random.unit()));
            ring.insert(ring.end(), {knee, corner});
        }
        std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(random.below(ring.size())),
                    ring.end());
        std::vector<double> found;
        for (const std::vector<Vec2>& spur : spurs_of(ring)) {
            double along = 0.0;
            for (std::size_t i = 1; i < spur.size(); ++i) along += distance(spur[i - 1], spur[i]);
            found.push_back(along);
        }
        std::sort(wanted.begin(), wanted.end());
        std::sort(found.begin(), found.end());
        ASSERT_EQ(found.size(), wanted.size()) << round;
        for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], wanted[i], 1e-9) << round;
    }
}

TEST(Spurs, OfAnOutlineAreSlitsOfItsPart) {
    const test::ReadDrawing reading = test::read_drawing(
        test::drawing("<path d='M5 5H95V55H50V40V55H5Z'/><path d='M5 60H30V75H40H30V60H55V80H5Z'/>"));
    EXPECT_EQ(reading.codes(), "");
    ASSERT_EQ(reading.parts().size(), 2U);
    ASSERT_EQ(reading.part(0).slits.size(), 1U);
    EXPECT_NEAR(drawing::length_of(reading.part(0).slits[0]), 15.0, 0.05);
    ASSERT_EQ(reading.part(1).slits.size(), 1U);
    EXPECT_NEAR(drawing::length_of(reading.part(1).slits[0]), 25.0, 0.05);
}

// What sticks out of a part is no slit, and is told of.
TEST(Spurs, OutsideOfTheirPartAreNotCut) {
    const test::ReadDrawing reading = test::read_drawing(test::drawing("<path d='M5 5H95V20H99H95V55H5Z'/>"));
    EXPECT_EQ(reading.codes(), "2:1 line-outside\n");
    EXPECT_TRUE(reading.part().slits.empty());
}

}  // namespace
}  // namespace popup
