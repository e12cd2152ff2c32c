// The checker checked: plates made by hand, whose meetings are known on paper.
#include "support/brute_force.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "popup/motion.h"
#include "support/designs.h"

namespace popup::test {
namespace {

constexpr double kApartMm = 10.0;  // between the axes of the two plates

double sine(double deg) { return std::sin(deg * std::numbers::pi / 180.0); }
// How far from their axes the two planes meet, at an opening angle (see leaning()).
double meeting(double deg) { return 0.5 * kApartMm / sine(0.5 * deg); }

Polygon box(double x0, double y0, double x1, double y1) {
    return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

void add_plate(Assembly& assembly, const std::string& name, Vec2 axis, double turn, Polygon outline) {
    const int number = static_cast<int>(assembly.plates.size());
    assembly.joints.push_back({name, {}, Drive{number, axis, {0, 1}, turn < 0.0 ? -1 : 1}});
    assembly.covers.push_back(number);
    Plate plate;
    plate.name = name;
    plate.outline = std::move(outline);
    plate.uncut = plate.outline.outer;
    assembly.plates.push_back(std::move(plate));
}

// Two plates that lean against each other: plate 0 goes up to the right from the y axis, a point (x, y) of it
// to (x s, y, x c) with s and c of half the opening angle; plate 1 up to the left from the line x = 10, a
// point (10 - x, y) to (10 - x s, y, x c). So they meet at x = 5 / s, at the opening angle to each other.
// Outlines are given with x from the axis.
Assembly leaning(Polygon right_going, Polygon left_going) {
    Assembly assembly;
    add_plate(assembly, "right-going", {0, 0}, 1.0, std::move(right_going));
    const auto mirror = [](Ring& ring) {
        for (Vec2& p : ring) p.x = kApartMm - p.x;
        std::reverse(ring.begin(), ring.end());
    };
    mirror(left_going.outer);
    std::for_each(left_going.holes.begin(), left_going.holes.end(), mirror);
    add_plate(assembly, "left-going", {kApartMm, 0}, -1.0, std::move(left_going));
    return assembly;
}

bool cross_at(const Assembly& assembly, double deg) {
    const auto found = BruteForce(assembly).crossing_at(deg);
    EXPECT_LE(found.size(), 1U);
    for (const BruteContact& one : found) EXPECT_TRUE(one.a == 0 && one.b == 1);
    return !found.empty();
}

class BruteForceCheck : public testing::Test {
 protected:
    void SetUp() override {
        if (!BruteForce::available()) GTEST_SKIP() << BruteForce::kMissing;
    }
};

TEST_F(BruteForceCheck, ABluntEdgeIsFoundFromAHundredthBeyondTheOtherPlateOn) {
    // Square to each other at 90°.
    const auto poking = [](double by) {
        return leaning(box(0, -20, meeting(90) + by, 20), box(0, -30, 40, 30));
    };
    EXPECT_TRUE(cross_at(poking(0.05), 90));
    EXPECT_TRUE(cross_at(poking(0.011), 90));
    EXPECT_FALSE(cross_at(poking(0.009), 90));
    EXPECT_FALSE(cross_at(poking(0.0), 90));
    EXPECT_FALSE(cross_at(poking(-0.05), 90));
}

TEST_F(BruteForceCheck, ObliquePlatesMustStandOutOfEachOtherNotOnlyReachAlongThePaper) {
    const auto poking = [](double by) {
        return leaning(box(0, -20, meeting(10) + by / sine(10), 20), box(0, -30, 90, 30));
    };
    EXPECT_TRUE(cross_at(poking(0.05), 10));
    EXPECT_TRUE(cross_at(poking(0.0028), 10));
    EXPECT_FALSE(cross_at(poking(0.0022), 10)) << "0.0127 mm of paper, but 0.0022 mm beyond";
    EXPECT_FALSE(cross_at(poking(-0.05), 10));
}

TEST_F(BruteForceCheck, TheCommonPointMustLieAHundredthInsideTheEdgesOfBoth) {
    const auto side_by_side = [](double overlap) {
        return leaning(box(0, -20, 30, 0.5 * overlap), box(0, -0.5 * overlap, 30, 20));
    };
    EXPECT_TRUE(cross_at(side_by_side(1.0), 90));
    EXPECT_TRUE(cross_at(side_by_side(0.022), 90));
    EXPECT_FALSE(cross_at(side_by_side(0.018), 90));
    EXPECT_FALSE(cross_at(side_by_side(0.0), 90));
    EXPECT_FALSE(cross_at(side_by_side(-0.05), 90));
}

TEST_F(BruteForceCheck, ATongueMayGoThroughAHole) {
    Polygon holed = box(0, -30, 40, 30);
    holed.holes.push_back({{2, -5}, {2, 5}, {20, 5}, {20, -5}});
    EXPECT_FALSE(cross_at(leaning(box(0, -5, 30, 5), holed), 90)) << "touches the rim on both sides";
    EXPECT_FALSE(cross_at(leaning(box(0, -4, 30, 4), holed), 90));
    EXPECT_TRUE(cross_at(leaning(box(0, -5.05, 30, 5), holed), 90));
    EXPECT_TRUE(cross_at(leaning(box(0, -4, 30, 4), holed), 28)) << "they meet beyond the hole";
}

TEST_F(BruteForceCheck, PaperElsewhereBeyondThePlaneDoesNotCount) {
    // A tongue that pokes through the other plate by `by` mm, and one beside it that goes far over its plane,
    // where the other has no paper.
    const auto two_tongues = [](double by) {
        const double reach = meeting(10) + by / sine(10);
        Polygon comb;
        comb.outer = {{0, -20}, {reach, -20}, {reach, -10}, {3, -10}, {3, 10}, {90, 10}, {90, 20}, {0, 20}};
        return leaning(comb, box(0, -25, 90, 0));
    };
    EXPECT_TRUE(cross_at(two_tongues(0.0028), 10));
    EXPECT_FALSE(cross_at(two_tongues(0.0022), 10));
    EXPECT_FALSE(cross_at(two_tongues(-0.02), 10));
}

TEST_F(BruteForceCheck, PlatesFlatOnOneAnotherDoNotCross) {
    const Assembly assembly = leaning(box(0, -20, 30, 20), box(0, -30, 30, 10));
    EXPECT_TRUE(cross_at(assembly, 90));
    EXPECT_TRUE(cross_at(assembly, 179));
    EXPECT_FALSE(cross_at(assembly, 180));
    EXPECT_FALSE(cross_at(assembly, 0)) << "parallel, 10 mm apart";
}

TEST_F(BruteForceCheck, PlatesThatShareFoldsSeamsCornersOrCutsDoNotCross) {
    const auto stand_still = [](const Design& design) {
        const Built built = build(design);
        const BruteForce brute(*built.assembly);
        for (int deg = 0; deg <= 180; ++deg) EXPECT_TRUE(brute.crossing_at(deg).empty()) << deg;
        EXPECT_TRUE(brute.crossing_at(0.25).empty());
    };
    stand_still(card());
    Design step = card();
    add(step, "step", {{-40, -30}, {-40, 30}, {25, -20}, {25, 35}});
    stand_still(step);
    Design beak = card();
    add(beak, "beak", {{0, -20}, {-40, 20}, {25, 30}});
    stand_still(beak);
    Design tent = card();
    add(tent, "tent",
        {{-30, -30}, {-30, 30}, {40, -30}, {40, 30}, {-35, -30}, {-35, 30}, {35, -30}, {35, 30}});
    stand_still(tent);
}

TEST_F(BruteForceCheck, AContactGoesOnUntilATenThousandth) {
    const double size = 6.0;
    const Assembly assembly = leaning(box(0, -20, size, 20), box(0, -30, size, 30));
    const auto holds = [&](double deg) { return (size - meeting(deg)) * sine(deg) > 0.0001; };
    const auto found = BruteForce(assembly).contact_around(0, 1, 150);
    ASSERT_TRUE(found);
    const auto is_end = [&](double end, double way) {
        EXPECT_TRUE(holds(end - 1.5e-4 * way) && !holds(end + 1.5e-4 * way)) << end;
    };
    is_end(found->first, -1);
    is_end(found->second, 1);
    EXPECT_FALSE(BruteForce(assembly).contact_around(0, 1, 100));
}

TEST_F(BruteForceCheck, TheLargestCircleOnBothStandsOutAsFarAsOnPaper) {
    // Square to each other the circle is bound by the nearest edge, the axis of either.
    const Assembly square = leaning(box(0, -20, 30, 20), box(0, -30, 40, 30));
    EXPECT_NEAR(BruteForce(square).through(0, 1, 90), meeting(90), 1e-5);
    // Oblique, and bound by the far edge of one.
    const Assembly oblique = leaning(box(0, -20, 30, 20), box(0, -30, 60, 30));
    EXPECT_NEAR(BruteForce(oblique).through(0, 1, 20), (30 - meeting(20)) * sine(20), 1e-5);
    // Bound by the rim of a hole and the edge of a tongue that is a little too wide for it.
    Polygon holed = box(0, -30, 40, 30);
    holed.holes.push_back({{2, -5}, {2, 5}, {20, 5}, {20, -5}});
    EXPECT_NEAR(BruteForce(leaning(box(0, -5.05, 30, 5), holed)).through(0, 1, 90), 0.025, 1e-5);
    EXPECT_EQ(BruteForce(leaning(box(0, -4, 30, 4), holed)).through(0, 1, 90), 0.0);
    // Bound by the edges of a strip 2 mm wide and the tip of a cut that ends 0.5 mm before the line: 0.375 mm
    // beside the tip both are 0.625 mm away.
    Polygon slit;
    const double tip = meeting(90) + 0.5;
    slit.outer = {{-20, -20}, {40, -20}, {40, -1}, {tip, 0}, {40, 1}, {40, 20}, {-20, 20}};
    EXPECT_NEAR(BruteForce(leaning(slit, box(-20, -1, 40, 1))).through(0, 1, 90), 0.625, 1e-5);
    // Beside the line nothing is common, and flat plates have no line.
    EXPECT_EQ(BruteForce(leaning(box(0, -20, 4, 20), box(0, -30, 4, 30))).through(0, 1, 90), 0.0);
    EXPECT_EQ(BruteForce(square).through(0, 1, 180), 0.0);
}

TEST_F(BruteForceCheck, DistancesAreThoseOnPaper) {
    const Assembly level = leaning(box(0, -20, 4, 20), box(0, -30, 4, 30));
    const Assembly aside = leaning(box(0, -20, 4, 0), box(0, 3, 4, 30));
    for (const double deg : {0.0, 1.0, 60.0, 90.0, 170.0, 180.0}) {
        const double gap = kApartMm - 8.0 * sine(0.5 * deg);
        EXPECT_NEAR(*BruteForce(level).closest(0, 1, deg), gap, 1e-9) << deg;
        EXPECT_NEAR(*BruteForce(aside).closest(1, 0, deg), std::hypot(gap, 3.0), 1e-9) << deg;
    }
    // The edge of one before the face of the other: measured square to the face.
    const Assembly before = leaning(box(0, -20, 4, 20), box(0, -30, 40, 30));
    EXPECT_NEAR(*BruteForce(before).closest(0, 1, 60), (meeting(60) - 4.0) * sine(60), 1e-9);
    EXPECT_EQ(*BruteForce(before).closest(0, 1, 180), 0.0);
    const Assembly through = leaning(box(0, -20, 30, 20), box(0, -30, 40, 30));
    EXPECT_EQ(*BruteForce(through).closest(0, 1, 90), 0.0);
    // Through a hole, from rim to tongue.
    Polygon holed = box(0, -30, 40, 30);
    holed.holes.push_back({{2, -5}, {2, 5}, {20, 5}, {20, -5}});
    const Assembly tongue = leaning(box(0, -4.5, 30, 4), holed);
    EXPECT_NEAR(*BruteForce(tongue).closest(0, 1, 90), 0.5, 1e-9);
}

TEST_F(BruteForceCheck, PlatesThatCannotMeetCostNoTestOfTriangles) {
    const Assembly apart = leaning(box(0, -20, 4, 20), box(0, -30, 4, 30));
    const BruteForce none(apart);
    EXPECT_TRUE(none.crossing_at(90).empty());
    EXPECT_EQ(none.triangle_tests(), 0U);
    const Assembly through = leaning(box(0, -20, 30, 20), box(0, -30, 40, 30));
    const BruteForce some(through);
    EXPECT_EQ(some.crossing_at(90).size(), 1U);
    EXPECT_GE(some.triangle_tests(), 1U);
}

}  // namespace
}  // namespace popup::test
