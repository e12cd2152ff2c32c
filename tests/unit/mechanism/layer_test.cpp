// Guarantees of the layer: flat on the open card and on the closed one, a parallelogram between, and mended
// into one where its numbers are not.
#include <gtest/gtest.h>

#include <cmath>

#include "mechanism/builder.h"
#include "popup/motion.h"
#include "support/designs.h"

namespace popup::test {
namespace {

// A layer over the gutter whose seams are p left and q right of it, with a piece that is `wide`.
std::vector<Vec2> layer(double p, double q, double wide) {
    const double h = 0.5 * wide;
    return {{-p, -30}, {-p, 30}, {q, -30}, {q, 30}, {-h, -30}, {-h, 30}, {h, -30}, {h, 30}};
}
std::vector<Vec2> layer(double p, double q) { return layer(p, q, p + q); }

std::optional<Motion> moved(const Assembly& assembly, Diagnostics& diagnostics) {
    MotionOptions options;
    for (int deg = 0; deg <= 180; ++deg) options.angles.push_back(Angle::degrees(deg));
    return simulate(assembly, options, diagnostics);
}

std::vector<Frame> frames_at(const Assembly& assembly, double deg) {
    std::vector<Frame> frames(assembly.plates.size());
    EXPECT_TRUE(place(assembly, Angle::degrees(deg), frames)) << deg;
    return frames;
}

void expect_folds(const Design& design) {
    const Built built = build(design);
    ASSERT_TRUE(built.assembly);
    EXPECT_EQ(findings(built.diagnostics), "");
    Diagnostics diagnostics;
    const auto motion = moved(*built.assembly, diagnostics);
    ASSERT_TRUE(motion) << findings(diagnostics);
    EXPECT_EQ(findings(diagnostics), "");
    EXPECT_LE(motion->max_closure_mm, 1e-6);
    EXPECT_TRUE(motion->flat_closed);
    for (const Frame& frame : frames_at(*built.assembly, 180))
        EXPECT_NEAR(std::abs(frame.normal().z), 1.0, 1e-9);
}

TEST(Layer, ClosesAtEveryAngleAndLiesFlatOnTheOpenCard) {
    for (const auto& [p, q] : {std::pair{40.0, 40.0}, {60.0, 30.0}, {12.0, 55.0}}) {
        SCOPED_TRACE(p);
        Design design = card(200, 150);
        add(design, "layer", layer(p, q));
        expect_folds(design);
    }
}

TEST(Layer, IsAParallelogramWhoseCentreFoldIsDisplacedByItsSeams) {
    Design design = card(200, 150);
    add(design, "strap", layer(60, 30));
    design.structures[0].type = find_element("strap")->name;
    const Built built = build(design);
    ASSERT_TRUE(built.assembly);
    const Fold& centre = built.checked->skeleton().folds[2];
    EXPECT_EQ(centre.on_left, (Segment{{-45 + 30, -30}, {-45 + 30, 30}}));
    EXPECT_EQ(centre.closed_deg, 360);
    for (const double deg : {0.0, 37.0, 90.0, 143.0, 180.0}) {
        const auto frames = frames_at(*built.assembly, deg);
        // The piece's left half is parallel to the page's right one, and its right half to the left.
        EXPECT_NEAR(length(frames[2].normal() - frames[1].normal()), 0.0, 1e-9) << deg;
        EXPECT_NEAR(length(frames[3].normal() - frames[0].normal()), 0.0, 1e-9) << deg;
    }
}

TEST(Layer, OthersStandOnItsFoldsAndSeamsAndFoldWithIt) {
    Design design = card(200, 150);
    add(design, "layer", layer(60, 30));
    add(design, "inverted-step", {{-25, -10}, {-25, 10}, {-5, -10}, {-5, 10}}, {-15, -30}, {-15, 30}, 1);
    Structure& on_seam =
        add(design, "layer",
            {{25, -20}, {25, 20}, {44, -20}, {44, 20}, {-17, -20}, {-17, 20}, {17, -20}, {17, 20}}, {30, -30},
            {30, 30}, 0);
    on_seam.points[0].page = on_seam.points[1].page = 1;
    expect_folds(design);
}

TEST(Layer, OfAnotherWidthIsMadeFlat) {
    for (const double wide : {70.0, 120.0}) {
        Design design = card(200, 150);
        add(design, "layer", layer(60, 30, wide));
        Diagnostics diagnostics;
        const auto checked = check(design, {}, diagnostics);
        ASSERT_TRUE(checked);
        const Diagnostic told = diagnostics.sorted().front();
        EXPECT_EQ(told.code, "layer-width");
        EXPECT_EQ(
            told.message,
            "\"e1\": the piece is " + std::string(wide < 90 ? "70.00" : "120.00") +
                " mm wide and its seams on the page are 90.00 mm apart, where a layer lies flat on the open "
                "card; it was made 90.00 mm wide");
        EXPECT_NEAR(checked->design().structures[0].points[4].at.x, -45, 1e-9);
        expect_folds(checked->design());
    }
}

TEST(Layer, OnAMountainFoldItsSeamsBecomeEven) {
    Design design = card(200, 150);
    add(design, "tent",
        {{-20, -60}, {-20, 60}, {20, -60}, {20, 60}, {-30, -60}, {-30, 60}, {30, -60}, {30, 60}});
    add(design, "layer",
        {{-12, -20}, {-12, 20}, {9, -20}, {9, 20}, {-10.5, -20}, {-10.5, 20}, {10.5, -20}, {10.5, 20}},
        {0, -60}, {0, 60}, 1);
    Diagnostics diagnostics;
    const auto checked = check(design, {}, diagnostics);
    ASSERT_TRUE(checked);
    const auto told = diagnostics.sorted();
    ASSERT_EQ(told.size(), 2U) << findings(diagnostics);
    EXPECT_EQ(told[0].message,
              "\"e2\": its seams are 12.00 mm and 9.00 mm away from the mountain fold, which hold it only at "
              "the same "
              "distance; both are now 9.00 mm away");
    EXPECT_EQ(told[1].code, "layer-width");
    EXPECT_NEAR(checked->design().structures[1].points[0].at.x, -9, 1e-9);
    EXPECT_NEAR(checked->design().structures[1].points[4].at.x, -9, 1e-9);
    const Built built = build(checked->design());
    ASSERT_TRUE(built.assembly);
    Diagnostics moving;
    const auto motion = moved(*built.assembly, moving);
    ASSERT_TRUE(motion) << findings(moving);
    EXPECT_EQ(findings(moving), "");
    EXPECT_LE(motion->max_closure_mm, 1e-6);
}

TEST(Layer, DrawnFromItsBackIsMirrored) {
    Design design = card(200, 150);
    std::vector<Vec2> points = layer(60, 30);
    for (std::size_t i = 4; i < 8; ++i) points[i].x = -points[i].x;
    add(design, "layer", points);
    Diagnostics diagnostics;
    const auto checked = check(design, {}, diagnostics);
    ASSERT_TRUE(checked);
    EXPECT_EQ(diagnostics.sorted().front().code, "piece-mirrored");
    expect_folds(checked->design());
}

}  // namespace
}  // namespace popup::test
