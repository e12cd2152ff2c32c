// What lies on the pages of an open card is drawn above them, and in the order in which it comes to lie.
#include "output/open_layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "output/still/model.h"
#include "popup/motion.h"
#include "support/designs.h"

namespace popup {
namespace {

// A layer over the gutter whose seams are `seam` left and right of it, `along` from the middle.
std::vector<Vec2> layer(double seam, double high, double along = 0.0) {
    const double low = along - high;
    const double top = along + high;
    return {{-seam, low}, {-seam, top}, {seam, low}, {seam, top},
            {-seam, low}, {-seam, top}, {seam, low}, {seam, top}};
}
// A layer within a wider one: both come to lie on the pages.
Design two_layers() {
    Design design = test::card();
    test::add(design, "layer", layer(20, 20));
    test::add(design, "layer", layer(40, 30));
    return design;
}

TEST(OpenLayers, AreNoneWhereNothingLiesOnAPage) {
    const test::Built card = test::build(test::card());
    ASSERT_TRUE(card.assembly) << test::findings(card.diagnostics);
    EXPECT_TRUE(open_layers(*card.assembly).empty());
}

TEST(OpenLayers, AreDrawnAboveTheirPages) {
    const test::Built card = test::build(two_layers());
    ASSERT_TRUE(card.assembly) << test::findings(card.diagnostics);
    const Assembly& assembly = *card.assembly;
    const std::vector<OpenLayer> layers = open_layers(assembly);
    ASSERT_EQ(layers.size(), assembly.plates.size());
    std::set<double> heights;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        if (layers[i].page < 0) continue;
        EXPECT_GE(layers[i].mm, kOpenLayerMm) << assembly.plates[i].name;
        EXPECT_TRUE(heights.insert(layers[i].mm).second) << "two in one plane";
    }
    EXPECT_EQ(heights.size(), 4U);
}

TEST(OpenLayers, AreToldApartOnLargeCardsAsOnSmallOnes) {
    constexpr int kPairs = 300;
    constexpr double kEachMm = 70.0;
    Design design = test::card(200.0, kPairs * kEachMm);
    for (int i = 0; i < kPairs; ++i) {
        const double along = kEachMm * (i - 0.5 * (kPairs - 1));
        test::add(design, "layer", layer(20, 20, along));
        test::add(design, "layer", layer(40, 30, along));
    }
    const test::Built card = test::build(design);
    ASSERT_TRUE(card.assembly) << test::findings(card.diagnostics);
    const std::vector<OpenLayer> layers = open_layers(*card.assembly);
    ASSERT_EQ(layers.size(), card.assembly->plates.size());
    EXPECT_EQ(std::ranges::count_if(layers, [](const OpenLayer& one) { return one.page >= 0; }), 4 * kPairs);
}

TEST(OpenLayers, AreInTheModelAboveThePagesOnlyWhenTheCardIsOpen) {
    const test::Built card = test::build(two_layers());
    ASSERT_TRUE(card.assembly) << test::findings(card.diagnostics);
    Diagnostics diagnostics;
    const auto motion = simulate(*card.assembly, {}, diagnostics);
    ASSERT_TRUE(motion) << test::findings(diagnostics);
    const SceneCard scene{&*card.assembly, &*motion, {}};
    still::Modeller modeller({&scene, 1}, false);
    const auto model = modeller.at(180.0, diagnostics);
    ASSERT_TRUE(model) << test::findings(diagnostics);
    int raised = 0;
    for (const still::Face& face : model->faces) {
        for (const Vec3 p : face.points) EXPECT_GE(p.z, -1e-9);
        if (face.points.front().z >= kOpenLayerMm - 1e-9) ++raised;
    }
    EXPECT_GE(raised, 4);
    std::vector<Frame> frames(card.assembly->plates.size());
    ASSERT_TRUE(place(*card.assembly, Angle::degrees(90.0), frames));
    EXPECT_EQ(share_of_open(*card.assembly, frames), 0.0);
    ASSERT_TRUE(place(*card.assembly, Angle::degrees(180.0), frames));
    EXPECT_NEAR(share_of_open(*card.assembly, frames), 1.0, 1e-6);
}

}  // namespace
}  // namespace popup
