// Plates that are folded by laws of their own.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "motion/joints/joint.h"
#include "popup/motion.h"
#include "support/laws.h"

namespace popup {
namespace {

using test::law_of;

TEST(Folded, LawsGoThroughTheirPointsAndFollowSmoothFunctions) {
    const auto wave = [](double x) { return 100.0 * std::sin(x / 40.0); };
    const std::vector<Vec2> law = law_of({0.0, 70.0, 180.0}, wave);
    for (const Vec2 point : law) EXPECT_NEAR(fold_angle_deg(law, point.x), point.y, 1e-12);
    for (double x = 0.0; x <= 180.0; x += 0.37) EXPECT_NEAR(fold_angle_deg(law, x), wave(x), 1e-7);
    EXPECT_EQ(fold_angle_deg(law, -5.0), law.front().y);
    EXPECT_EQ(fold_angle_deg(law, 185.0), law.back().y);
    EXPECT_NEAR(fold_angle_deg({{0.0, -90.0}, {180.0, 0.0}}, 45.0), -67.5, 1e-12);
}

TEST(Folded, TurnsItsPlateAboutTheLine) {
    std::vector<Frame> frames(2);
    const Joint still{"sheet/1", {}, Still{0}};
    const Joint folded{"sheet/2", {}, Folded{1, 0, {30.0, 0.0}, {0.0, 1.0}, {{0.0, 90.0}, {180.0, 0.0}}}};
    ASSERT_TRUE(place_plates(still, Angle::degrees(0.0), frames));
    ASSERT_TRUE(place_plates(folded, Angle::degrees(0.0), frames));
    // What is on the left of the line comes up; the line stays.
    EXPECT_LT(distance(frames[1].point({10.0, 7.0}), {30.0, 7.0, 20.0}), 1e-12);
    EXPECT_LT(distance(frames[1].point({30.0, 7.0}), {30.0, 7.0, 0.0}), 1e-12);
    ASSERT_TRUE(place_plates(folded, Angle::degrees(180.0), frames));
    EXPECT_LT(distance(frames[1].point({10.0, 7.0}), {10.0, 7.0, 0.0}), 1e-12);
}

// A chain of folds to and fro keeps its plates square, however long it is.
TEST(Folded, StaysRigidInLongChains) {
    std::vector<Joint> joints{{"0", {}, Still{0}}};
    for (int i = 1; i < 60; ++i) {
        const double angle = i % 2 == 0 ? 179.0 : -179.0;
        joints.push_back(
            {"", {}, Folded{i, i - 1, {10.0 * i, 0.0}, unit(Vec2{0.1, -1.0}), {{0.0, angle}, {180.0, 0.0}}}});
    }
    std::vector<Frame> frames(joints.size());
    for (const Joint& joint : joints) ASSERT_TRUE(place_plates(joint, Angle::degrees(0.0), frames));
    for (const Frame& frame : frames) {
        EXPECT_NEAR(length(frame.axes[0]), 1.0, 1e-13);
        EXPECT_NEAR(dot(frame.axes[0], frame.axes[1]), 0.0, 1e-13);
        EXPECT_LT(distance(cross(frame.axes[0], frame.axes[1]), frame.axes[2]), 1e-13);
    }
}

TEST(Folded, NamesItsFaults) {
    const Folded sound{1, 0, {}, {0.0, 1.0}, {{0.0, 90.0}, {180.0, 0.0}}};
    const auto fault = [&](const auto& change) {
        Folded how = sound;
        change(how);
        return fault_of(Joint{"", {}, how}).value_or("none");
    };
    EXPECT_EQ(fault([](Folded&) {}), "none");
    EXPECT_EQ(fault([](Folded& how) { how.dir = {0.0, 2.0}; }), "dir is no unit vector");
    EXPECT_EQ(fault([](Folded& how) { how.base = 1; }), "plate and base are one plate");
    EXPECT_EQ(fault([](Folded& how) { how.law.pop_back(); }),
              "law_deg has 1 points; it has 2, or 1 and a multiple of 12");
    EXPECT_EQ(fault([](Folded& how) { how.law[1].x = 0.0; }),
              "law_deg goes from an opening of 0 to one of 0: they must rise");
    EXPECT_EQ(fault([](Folded& how) { how.law = law_of({0.0, 90.0}, [](double x) { return x; }); }), "none");
    EXPECT_EQ(fault([](Folded& how) {
                  how.law = law_of({0.0, 90.0}, [](double x) { return x; });
                  how.law[3].x += 0.5;
              }).substr(0, 38),
              "law_deg has a point at an opening of 1");
}

}  // namespace
}  // namespace popup
