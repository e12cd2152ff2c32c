// Folded sheets stand on the ground.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "output/orientation.h"
#include "output/still/model.h"
#include "support/folded_sheet.h"

namespace popup {
namespace {

using test::add_line;
using test::FoldedSheet;
using test::tube;

TEST(FoldedSheets, StandOnTheGroundAtEveryOpening) {
    const FoldedSheet sheet(tube(CreaseUse::mountain));
    const SceneCard card = sheet.card();
    still::Modeller modeller({&card, 1}, false);
    for (const double deg : {0.0, 20.0, 45.0, 90.0, 135.0, 180.0}) {
        Diagnostics diagnostics;
        const auto model = modeller.at(deg, diagnostics);
        ASSERT_TRUE(model);
        double low = HUGE_VAL;
        for (const still::Face& face : model->faces) {
            for (const Vec3 p : face.points) low = std::min(low, p.z);
        }
        EXPECT_NEAR(low, 0.0, 0.11) << deg;
    }
}

// Two pieces of one sheet: each stands by itself.
TEST(FoldedSheets, StandEachByItself) {
    CreasePattern pattern;
    add_line(pattern, {{0, 0}, {60, 0}, {60, 40}, {0, 40}}, true, CreaseUse::cut);
    add_line(pattern, {{30, 0}, {30, 40}}, false, CreaseUse::mountain, 90.0);
    add_line(pattern, {{100, 0}, {120, 0}, {120, 40}, {100, 40}}, true, CreaseUse::cut);
    add_line(pattern, {{110, 0}, {110, 40}}, false, CreaseUse::mountain, 90.0);
    const FoldedSheet sheet(pattern);
    std::vector<Frame> frames = sheet.at(0.0);
    settle(*sheet.assembly, frames);
    std::vector<double> low(sheet.assembly->pieces.size(), HUGE_VAL);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const Plate& plate = sheet.assembly->plates[i];
        double& lowest = low[static_cast<std::size_t>(plate.piece)];
        for (const Vec2 p : plate.outline.outer) lowest = std::min(lowest, frames[i].point(p).z);
    }
    ASSERT_EQ(low.size(), 2U);
    for (const double z : low) EXPECT_NEAR(z, 0.0, 1e-9);
}

}  // namespace
}  // namespace popup
