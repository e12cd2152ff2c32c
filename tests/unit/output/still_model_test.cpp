// The model of parts that stand still, read from its file as any viewer does.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "input/flatlang/pieces/pieces.h"
#include "output/emit.h"
#include "output/gltf.h"
#include "popup/pattern.h"
#include "support/designs.h"
#include "support/glb_scene.h"
#include "support/run_program.h"
#include "support/trails.h"

namespace popup {
namespace {

using test::GlbNode;
using test::GlbPart;
using test::GlbScene;
using test::Point3;
using test::TrailMaker;

constexpr double kInchMetres = 0.0254;

// A box without a lid whose front has a window, a loose plate above it, and lines.
TrailMaker box() {
    TrailMaker maker;
    maker.line({-1, -1, 0}, {-2, -1, 0});
    maker.part("box");
    maker.square(0, 0, 4);
    maker.rectangle({0, 0, 0}, {4, 0, 0}, {0, 0, 3});
    maker.rectangle({1, 0, 1}, {2, 0, 0}, {0, 0, 1});
    maker.rectangle({0, 4, 0}, {4, 0, 0}, {0, 0, 3});
    maker.rectangle({0, 0, 0}, {0, 4, 0}, {0, 0, 3});
    maker.rectangle({4, 0, 0}, {0, 4, 0}, {0, 0, 3});
    maker.part("lid");
    maker.rectangle({0, 0, 5}, {4, 0, 0}, {0, 4, 1});
    maker.line({0, 0, 5}, {0, 0, 3});
    return maker;
}

Assembly parts_of(const TrailMaker& maker) {
    Diagnostics diagnostics("box.fl");
    auto list = flatlang::make_parts(maker.trail, diagnostics);
    EXPECT_TRUE(list) << test::findings(diagnostics);
    return assembly_of(list.value_or(FlatParts{}));
}

SceneCard card_of(Assembly& parts, const std::string& stem, const std::string& prefix = {}) {
    parts.stem = stem;
    SceneCard card;
    card.assembly = &parts;
    card.prefix = prefix;
    return card;
}

std::string glb_of(const std::vector<SceneCard>& cards, const OutputOptions& options = {}) {
    Diagnostics diagnostics;
    const auto bytes = write_glb(cards, options, diagnostics);
    EXPECT_TRUE(bytes) << test::findings(diagnostics);
    return bytes.value_or("");
}

GlbScene read(const std::string& bytes) {
    std::string error;
    auto scene = test::read_glb(bytes, &error);
    EXPECT_TRUE(scene) << error;
    return scene.value_or(GlbScene{});
}

const GlbNode& node_named(const GlbScene& scene, const std::string& name) {
    for (const GlbNode& node : scene.nodes) {
        if (node.name == name) return node;
    }
    ADD_FAILURE() << "no node " << name;
    static const GlbNode none;
    return none;
}

Vec3 at(const GlbPart& part, std::uint32_t i) {
    const Point3& p = part.points.at(i);
    return {p[0], p[1], p[2]};
}

double distance_to(const Vec3& p, const std::vector<Vec3>& inches) {
    double nearest = HUGE_VAL;
    for (const Vec3 q : inches) nearest = std::min(nearest, distance(p, kInchMetres * q));
    return nearest;
}

TEST(StillModel, APartIsANodeWithItsFacesAndLinesWhereTheyWereDrawn) {
    const TrailMaker maker = box();
    Assembly list = parts_of(maker);
    OutputOptions options;
    options.edge_lines = false;
    const GlbScene scene = read(glb_of({card_of(list, "box")}, options));
    ASSERT_EQ(scene.nodes.size(), 4U);
    EXPECT_TRUE(scene.times.empty());
    EXPECT_EQ(scene.nodes[0].name, "box");
    std::vector<Vec3> corners;
    for (const auto& polygon : maker.trail.polygons) {
        corners.insert(corners.end(), polygon.points.begin(), polygon.points.end());
    }
    std::map<std::string, double> area;
    std::map<std::string, double> drawn;
    for (const GlbNode& node : scene.nodes) {
        for (const GlbPart& part : node.parts) {
            EXPECT_EQ(part.lines.empty(), !part.triangles.empty());
            for (const auto& triangle : part.triangles) {
                const Vec3 cross_product = cross(at(part, triangle[1]) - at(part, triangle[0]),
                                                 at(part, triangle[2]) - at(part, triangle[0]));
                area[node.name] += 0.5 * length(cross_product);
                for (const std::uint32_t corner : triangle) {
                    EXPECT_LT(distance_to(at(part, corner), corners), 1e-7);
                    // A normal says which side is the triangle's front.
                    const Point3& n = part.normals.at(corner);
                    EXPECT_GT(dot(unit(cross_product), Vec3{n[0], n[1], n[2]}), 1 - 1e-6);
                }
            }
            if (!part.triangles.empty()) {
                EXPECT_TRUE(part.double_sided);
            }
            for (const auto& line : part.lines)
                drawn[node.name] += distance(at(part, line[0]), at(part, line[1]));
        }
    }
    constexpr double kSquareInch = kInchMetres * kInchMetres;
    EXPECT_NEAR(area["box"], (16 + 4 * 12 - 2) * kSquareInch, 1e-8);
    EXPECT_NEAR(area["lid"], 4 * std::sqrt(17.0) * kSquareInch, 1e-8);
    EXPECT_EQ(area.size(), 2U);
    EXPECT_NEAR(drawn["box"], (16 + 4 * 14 + 6) * kInchMetres, 1e-6);
    EXPECT_NEAR(drawn["lid"], (8 + 2 * std::sqrt(17.0) + 2) * kInchMetres, 1e-6);
    EXPECT_NEAR(drawn["trail"], 1 * kInchMetres, 1e-6);
    EXPECT_EQ(node_named(scene, "lid").part, "lid");
    EXPECT_EQ(node_named(scene, "trail").part, "");
}

TEST(StillModel, TheSameTrailIsTheSameBytes) {
    Assembly a = parts_of(box());
    Assembly b = parts_of(box());
    EXPECT_EQ(glb_of({card_of(a, "box")}), glb_of({card_of(b, "box")}));
}

// A card and a program in one run: the card moves, the parts stand beside it.
TEST(StillModel, StandsBesideCardsThatMove) {
    test::Built built = test::build(test::row(5));
    ASSERT_TRUE(built.assembly);
    MotionOptions motion_options;
    motion_options.examine = false;
    const auto motion = simulate(*built.assembly, motion_options, built.diagnostics);
    ASSERT_TRUE(motion);
    Assembly list = parts_of(box());
    SceneCard castle;
    castle.assembly = &*built.assembly;
    castle.motion = &*motion;
    castle.prefix = "castle:";
    const SceneCard parts = card_of(list, "box", "box:");
    for (const bool first : {false, true}) {
        const auto cards =
            first ? std::vector<SceneCard>{parts, castle} : std::vector<SceneCard>{castle, parts};
        const GlbScene scene = read(glb_of(cards));
        EXPECT_FALSE(scene.times.empty());
        EXPECT_GT(scene.channels, 0);
        const auto poses = test::rest_pose(scene);
        // Nothing of one stands at the x of anything of the other, at any angle.
        const auto range = [&](const std::string& prefix, double angle) {
            std::pair<double, double> x{HUGE_VAL, -HUGE_VAL};
            const auto standing = test::pose_at_angle(scene, angle);
            for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
                if (!scene.nodes[i].name.starts_with(prefix)) continue;
                for (const GlbPart& part : scene.nodes[i].parts) {
                    for (const Point3& p : part.points) {
                        const double one = standing[i].point(p)[0];
                        x = {std::min(x.first, one), std::max(x.second, one)};
                    }
                }
            }
            return x;
        };
        for (const double angle : {0.0, 90.0, 180.0}) {
            const auto left = range(first ? "box:" : "castle:", angle);
            const auto right = range(first ? "castle:" : "box:", angle);
            EXPECT_GE(right.first - left.second, 0.0199);
        }
        for (const GlbNode& node : scene.nodes) {
            if (node.name.starts_with("box:")) {
                EXPECT_TRUE(node.turns.empty());
            }
        }
    }
}

TEST(StillModel, KhronosValidatorFindsNothing) {
    const TrailMaker maker = box();
    Assembly list = parts_of(maker);
    if (std::getenv("POPUP_GLTF_VALIDATOR") == nullptr || !test::have_program("node")) {
        GTEST_SKIP() << "POPUP_GLTF_VALIDATOR does not say where gltf-validator is, or there is no node";
    }
    const test::ScratchDirectory scratch;
    const SceneCard card = card_of(list, "box");
    Diagnostics diagnostics;
    test::write_file(scratch / "model.glb", glb_of({card}));
    test::write_file(scratch / "model.gltf", write_gltf({&card, 1}, {}, diagnostics).value_or(""));
    const auto result = test::run({"node", std::string(POPUP_SOURCE_DIR) + "/tests/tools/validate_gltf.mjs",
                                   (scratch / "model.glb").string(), (scratch / "model.gltf").string()});
    EXPECT_EQ(result.exit, 0) << result.out << result.err;
}

TEST(StillModel, FoldsOfPartsAreEmittedWithTheirAngles) {
    Assembly list = parts_of(box());
    Diagnostics diagnostics;
    const auto pattern = make_pattern(list, PatternOptions{}, diagnostics);
    ASSERT_TRUE(pattern);
    const auto json = nlohmann::json::parse(emit_pattern(*pattern));
    int folds = 0;
    for (const auto& piece : json.at("pieces")) {
        for (const auto& line : piece.at("lines")) {
            ASSERT_TRUE(line.contains("fold_deg")) << line;
            EXPECT_NEAR(line.at("fold_deg").get<double>(), 90.0, 1e-6);
            EXPECT_EQ(line.at("kind"), "valley");
            ++folds;
        }
    }
    EXPECT_EQ(folds, 4);
}

}  // namespace
}  // namespace popup
