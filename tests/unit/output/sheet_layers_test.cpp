// Panels of a folded sheet that lie on one another are told apart, by the way in which they came there.
#include "output/sheet_layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "output/apart.h"
#include "output/gltf.h"
#include "output/orientation.h"
#include "output/still/model.h"
#include "output/still/render.h"
#include "support/folded_sheet.h"
#include "support/glb_scene.h"

namespace popup {
namespace {

using test::add_line;
using test::FoldedSheet;
using test::tube;

// A panel of 50 mm with a flap of 20 mm, which is folded right over.
CreasePattern hem(CreaseUse use) {
    CreasePattern pattern;
    add_line(pattern, {{0, 0}, {70, 0}, {70, 40}, {0, 40}}, true, CreaseUse::cut);
    add_line(pattern, {{50, 0}, {50, 40}}, false, use, 180.0);
    return pattern;
}

TEST(SheetLayers, AreOnTheSideFromWhichAFlapCame) {
    for (const CreaseUse use : {CreaseUse::valley, CreaseUse::mountain}) {
        const FoldedSheet sheet(hem(use));
        const std::size_t panel = sheet.plate_at({10, 20});
        const std::size_t flap = sheet.plate_at({60, 20});
        SheetLayers layers(*sheet.assembly);
        const std::vector<Frame> frames = sheet.at(0.0);
        const std::vector<double> levels = layers.at(0.0, frames);
        ASSERT_EQ(levels.size(), 2U);
        EXPECT_EQ(levels[panel], 0.0) << "the larger one stays";
        const Vec3 way = levels[flap] * frames[flap].normal();
        // A valley is folded to the front of the panel, a mountain to its back.
        EXPECT_NEAR(dot(way, frames[panel].normal()), use == CreaseUse::valley ? 1.0 : -1.0, 1e-9);
        EXPECT_TRUE(layers.at(90.0, sheet.at(90.0)).empty());
        EXPECT_TRUE(layers.at(180.0, sheet.at(180.0)).empty());
    }
}

TEST(SheetLayers, PutTheGlueFlapOfATubeInside) {
    for (const CreaseUse use : {CreaseUse::valley, CreaseUse::mountain}) {
        const FoldedSheet sheet(tube(use));
        const std::size_t wall = sheet.plate_at({10, 15});
        const std::size_t opposite = sheet.plate_at({100, 15});
        const std::size_t flap = sheet.plate_at({170, 15});
        Apart apart(sheet.card());
        const std::vector<Frame> frames = sheet.at(0.0);
        const std::vector<Vec3> lifts = apart.lifts({.frames = frames, .opening_deg = 0.0});
        EXPECT_EQ(lifts[wall], Vec3{});
        const Vec3 in = unit(frames[opposite].point({100, 15}) - frames[flap].point({170, 15}));
        EXPECT_GT(dot(lifts[flap], in), 0.05);
        // And by the paper, where it is thick.
        const std::vector<Vec3> thick = apart.lifts({.frames = frames, .opening_deg = 0.0, .paper_mm = 0.5});
        EXPECT_GE(length(thick[flap]), 0.5);
    }
}

// The edges of the flap are nowhere to be seen from outside: the wall has one light all over its middle.
TEST(SheetLayers, HideFlapsBehindWallsInPictures) {
    for (const CreaseUse use : {CreaseUse::valley, CreaseUse::mountain}) {
        const FoldedSheet sheet(tube(use));
        const std::size_t wall = sheet.plate_at({10, 15});
        const SceneCard card = sheet.card();
        for (const double paper_mm : {0.0, 0.5}) {
            still::Modeller modeller({&card, 1}, false, paper_mm);
            Diagnostics diagnostics;
            const auto model = modeller.at(0.0, diagnostics);
            ASSERT_TRUE(model);
            std::vector<Frame> frames = sheet.at(0.0);
            settle(*sheet.assembly, frames);
            Vec3 centre;
            for (const Vec2 p : {Vec2{10, 15}, Vec2{65, 15}, Vec2{100, 15}, Vec2{145, 15}})
                centre = centre + 0.25 * frames[sheet.plate_at(p)].point(p);
            const Vec3 front = frames[wall].normal();
            const bool faces_out = dot(front, frames[wall].point({10, 15}) - centre) > 0.0;
            const Vec3 out = faces_out ? front : -front;
            for (const double slant : {0.0, 0.4, -0.8}) {
                const Vec3 eye = out + slant * frames[wall].axes[0] + Vec3{1e-3, 2e-3, 3e-3};
                still::Framer framer(eye, 200, 160);
                framer.measure(*model);
                framer.aim(*model);
                const still::Framing framing = framer.framing();
                const Pixels pixels = still::render(*model, framing, 200, 160);
                const auto at = [&](Vec2 p) {
                    const still::Seen seen = framing.camera.see(frames[wall].point(p) + 0.5 * paper_mm * out);
                    const auto i = 3 * static_cast<std::size_t>(static_cast<int>(seen.y) * 200 +
                                                                static_cast<int>(seen.x));
                    return pixels.rgb[i];
                };
                for (double x = 5.0; x < 46.0; x += 0.5)
                    EXPECT_EQ(at({x, 15}), at({25, 15})) << "at " << x << ", slant " << slant;
            }
        }
    }
}

TEST(SheetLayers, AreToldApartInModels) {
    const FoldedSheet sheet(tube(CreaseUse::valley));
    const SceneCard card = sheet.card();
    Diagnostics diagnostics;
    const auto bytes = write_glb({&card, 1}, {}, diagnostics);
    ASSERT_TRUE(bytes);
    std::string error;
    const auto scene = test::read_glb(*bytes, &error);
    ASSERT_TRUE(scene) << error;
    const auto number_of = [&](std::size_t plate) {
        for (std::size_t i = 0; i < scene->nodes.size(); ++i) {
            if (scene->nodes[i].plate == sheet.assembly->plates[plate].name) return i;
        }
        return scene->nodes.size();
    };
    const std::size_t wall = number_of(sheet.plate_at({10, 15}));
    const std::size_t flap = number_of(sheet.plate_at({170, 15}));
    ASSERT_LT(std::max(wall, flap), scene->nodes.size());
    const auto apart_mm = [&](double deg) {
        const auto poses = test::pose_at_angle(*scene, deg);
        const auto& normal = poses[wall].axes[2];
        double sum = 0.0;
        for (std::size_t k = 0; k < 3; ++k)
            sum += 1e3 * normal.at(k) * (poses[flap].origin.at(k) - poses[wall].origin.at(k));
        return std::abs(sum);
    };
    EXPECT_NEAR(apart_mm(0.0), 0.1, 1e-3);
}

}  // namespace
}  // namespace popup
