// Plates that stay parallel to one plate and turn about a line of another: where they are, and that what is
// said of them once for all openings is what is true at each.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "motion/joints/joint.h"
#include "motion/parallels.h"
#include "popup/language.h"
#include "popup/motion.h"
#include "support/brute_force.h"
#include "support/designs.h"

namespace popup {
namespace {

// A card of 100 × 2 · 80 mm with a box: `face-0` stands 30 mm before the back, 40 mm wide and 40 mm high.
Assembly box() {
    const std::string text =
        R"({"settings": {"cardW": 100, "cardH": 80}, "faces": [{"t": 30, "contours": [{"outer":
            [{"X": 30, "Y": 30}, {"X": 70, "Y": 30}, {"X": 70, "Y": -10}, {"X": 30, "Y": -10}]}]}]})";
    Diagnostics diagnostics("box.oa");
    Reading reading = read_source_text(Source{"box.oa", text}, {}, diagnostics);
    EXPECT_TRUE(reading.assembly) << test::findings(diagnostics);
    return std::move(*reading.assembly);
}
enum Plates { kBack, kFloor, kTop, kFace };

Polygon rectangle(double x0, double y0, double x1, double y1) {
    return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

TEST(Parallel, MovesItsPlateAlongTheCarrier) {
    const Assembly assembly = box();
    ASSERT_EQ(assembly.plates[kFace].name, "face-0");
    std::vector<Frame> frames(assembly.plates.size());
    for (const double deg : {0.0, 17.0, 90.0, 151.0, 180.0}) {
        ASSERT_TRUE(place(assembly, Angle::degrees(deg), frames));
        const double half = Angle::degrees(deg).rad() / 2.0;
        const Vec3 up{-std::sin(half), 0.0, std::cos(half)};
        const Vec3 out{std::sin(half), 0.0, std::cos(half)};
        // A point of the face, 12 mm above the floor; one of the top, 25 mm before the back.
        EXPECT_LT(distance(frames[kFace].point({18.0, 5.0}), 30.0 * out + 12.0 * up + Vec3{0, 5, 0}), 1e-9);
        EXPECT_LT(distance(frames[kTop].point({-15.0, 5.0}), 25.0 * out + 40.0 * up + Vec3{0, 5, 0}), 1e-9);
        EXPECT_LT(distance(frames[kFace].normal(), frames[kBack].normal()), 1e-12);
        EXPECT_LT(distance(frames[kTop].normal(), frames[kFloor].normal()), 1e-12);
    }
}

TEST(Parallel, NamesItsFaults) {
    const Assembly assembly = box();
    const auto fault = [&](const auto& change) {
        Joint joint = assembly.joints.back();
        change(std::get<Parallel>(joint.how));
        return fault_of(joint).value_or("none");
    };
    EXPECT_EQ(fault([](Parallel&) {}), "none");
    EXPECT_EQ(fault([](Parallel& how) { how.carrier_dir = {0.0, 2.0}; }), "carrier_dir is no unit vector");
    EXPECT_EQ(fault([](Parallel& how) { how.own_dir = {0.5, 0.5}; }), "own_dir is no unit vector");
    EXPECT_EQ(fault([](Parallel& how) { how.like = how.carrier; }), "like and carrier are one plate");
    // A line across the fold is not parallel to the plate that it must be parallel to.
    Assembly aslant = assembly;
    std::get<Parallel>(aslant.joints.back().how).carrier_dir = {1.0, 0.0};
    std::vector<Frame> frames(aslant.plates.size());
    int stuck = -1;
    EXPECT_FALSE(place(aslant, Angle::degrees(50.0), frames, &stuck));
    EXPECT_EQ(stuck, static_cast<int>(aslant.joints.size()) - 1);
}

TEST(Parallel, WhatMeetsOnTheCommonLineCrossesAtEveryOpening) {
    struct Case {
        Polygon top;
        bool crosses;
    };
    // The line of top and face is x = -10 on both; the face reaches from x = -30, say, to 30 and from y = -20
    // to 20.
    for (const Case& one : {Case{rectangle(-40.0, -10.0, 5.0, 10.0), true},     // through the face
                            Case{rectangle(-40.0, 21.0, 5.0, 40.0), false},     // past it
                            Case{rectangle(-40.0, -40.0, -10.0, 40.0), false},  // up to it
                            Case{rectangle(-40.0, 20.0, 5.0, 40.0), false},     // along its edge
                            Case{rectangle(-40.0, 19.95, 5.0, 40.0), true}}) {  // just into it
        Assembly assembly = box();
        assembly.plates[kFace].outline = rectangle(-30.0, -20.0, 30.0, 20.0);
        assembly.plates[kTop].outline = one.top;
        std::vector<PlateShape> shapes;
        for (const Plate& plate : assembly.plates) shapes.push_back(plate_shape(plate));
        Parallels parallels(assembly, shapes);
        EXPECT_EQ(parallels.keep_apart(kTop, kFace), !one.crosses);
        EXPECT_EQ(parallels.keep_apart(kFace, kTop), !one.crosses);
        EXPECT_TRUE(parallels.keep_apart(kBack, kFace));
        const Examination found = examine(assembly, {});
        bool contact = false;
        for (const Contact& each : found.contacts) contact = contact || (each.a == kTop && each.b == kFace);
        EXPECT_EQ(contact, one.crosses);
        if (!test::BruteForce::available()) continue;
        const test::BruteForce brute(assembly);
        for (const double deg : {20.0, 45.0, 89.0, 120.0})
            EXPECT_EQ(brute.crosses(kTop, kFace, deg), one.crosses);
    }
}

// Nothing is known of plates whose back and floor share no line: their planes may cross anywhere.
TEST(Parallel, WithoutALineOfTheTwoNothingIsSaid) {
    Assembly assembly = box();
    std::vector<PlateShape> shapes;
    for (const Plate& plate : assembly.plates) shapes.push_back(plate_shape(plate));
    EXPECT_TRUE(Parallels(assembly, shapes).keep_apart(kTop, kFace));
    std::erase_if(assembly.hinges, [](const Hinge& hinge) { return hinge.a + hinge.b == kBack + kFloor; });
    EXPECT_TRUE(Parallels(assembly, shapes).keep_apart(kTop, kFace));  // the world drives both about one line
    std::get<Drive>(assembly.joints[1].how).axis_at.x = 3.0;
    EXPECT_FALSE(Parallels(assembly, shapes).keep_apart(kTop, kFace));
}

}  // namespace
}  // namespace popup
