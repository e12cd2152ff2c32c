// What models look like: their paper, what is printed on it, and their edges.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "output/gltf.h"
#include "support/glb_models.h"

namespace popup {
namespace {

using test::glb_of;
using test::GlbModel;
using test::GlbNode;
using test::GlbPart;
using test::GlbScene;
using test::model_of;
using test::node_named;
using test::Point3;
using test::read_scene;
using test::small_design;

// The area of paper in mm², all of it seen from the side that the sign says.
double paper_area(const GlbPart& paper, double sign) {
    double sum = 0.0;
    for (const auto& t : paper.triangles) {
        Ring ring;
        for (const auto corner : t) {
            const Point3& p = paper.points.at(corner);
            EXPECT_EQ(p[2], 0.0);
            EXPECT_EQ(paper.normals.at(corner), (Point3{0.0, 0.0, sign}));
            ring.push_back({1000 * p[0], 1000 * p[1]});
        }
        EXPECT_GT(sign * signed_area(ring), 0.0);
        sum += sign * signed_area(ring);
    }
    return sum;
}

TEST(GltfLook, MeshesAreThePlatesWithTheirHoles) {
    const GlbModel model = model_of(small_design());
    const GlbScene scene = read_scene(glb_of(model));
    for (const Plate& plate : model.assembly.plates) {
        const GlbNode& node = scene.nodes[static_cast<std::size_t>(node_named(scene, plate.name))];
        ASSERT_FALSE(node.parts.empty()) << plate.name;
        EXPECT_NEAR(paper_area(node.parts[0], 1.0), area(plate.outline), 1e-3 * area(plate.outline))
            << plate.name;
    }
}

TEST(GltfLook, BehindWhatIsPrintedOnItsFrontPaperIsBare) {
    const GlbModel model = model_of(small_design());
    OutputOptions both;
    both.backs = true;
    const GlbScene scene = read_scene(glb_of(model));
    const GlbScene printed = read_scene(glb_of(model, both));
    int coloured = 0;
    for (const Plate& plate : model.assembly.plates) {
        const auto number = static_cast<std::size_t>(node_named(scene, plate.name));
        const std::vector<GlbPart>& parts = scene.nodes[number].parts;
        EXPECT_TRUE(printed.nodes[number].parts.at(0).double_sided) << plate.name;
        EXPECT_EQ(printed.nodes[number].parts.at(0).color, parts.at(0).color) << plate.name;
        EXPECT_EQ(parts.at(0).double_sided, !plate.fill) << plate.name;
        if (!plate.fill) continue;
        ++coloured;
        EXPECT_FALSE(parts.at(1).double_sided) << plate.name;
        EXPECT_EQ(parts.at(1).color, (Point3{1.0, 1.0, 1.0})) << plate.name;
        EXPECT_NEAR(paper_area(parts.at(1), -1.0), area(plate.outline), 1e-3 * area(plate.outline))
            << plate.name;
    }
    EXPECT_EQ(coloured, 2);
}

// How long all lines of a colour are, in mm.
double lines_mm(const GlbNode& node, double channel) {
    double sum = 0.0;
    for (const GlbPart& part : node.parts) {
        if (part.lines.empty() || std::abs(part.color[0] - channel) > 1e-3) continue;
        for (const auto& line : part.lines) {
            const Point3& a = part.points.at(line[0]);
            const Point3& b = part.points.at(line[1]);
            sum += 1000.0 * std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]);
        }
    }
    return sum;
}

TEST(GltfLook, LinesRunAlongCutEdgesAndFolds) {
    constexpr double kEdge = 0.029557;  // #303030 and #909090 as light
    constexpr double kFold = 0.278894;
    const GlbModel model = model_of(small_design());
    const GlbScene scene = read_scene(glb_of(model));
    for (const Plate& plate : model.assembly.plates) {
        const GlbNode& node = scene.nodes[static_cast<std::size_t>(node_named(scene, plate.name))];
        double around = 0.0;
        const auto add = [&around](const Ring& ring) {
            for (std::size_t i = 0; i < ring.size(); ++i)
                around += distance(ring[i], ring[(i + 1) % ring.size()]);
        };
        add(plate.outline.outer);
        for (const Ring& hole : plate.outline.holes) add(hole);
        EXPECT_NEAR(lines_mm(node, kEdge) + lines_mm(node, kFold), around, 1e-3) << plate.name;
    }
    // Each half of the v-fold turns about its centre fold, from (0, 0) to (0, 80); its foot is glued.
    EXPECT_NEAR(lines_mm(scene.nodes[static_cast<std::size_t>(node_named(scene, "e1/left"))], kFold), 80.0,
                1e-3);
    OutputOptions none;
    none.edge_lines = false;
    for (const GlbNode& node : read_scene(glb_of(model, none)).nodes) {
        for (const GlbPart& part : node.parts) EXPECT_TRUE(part.lines.empty()) << node.name;
    }
}

TEST(GltfLook, PlatesOfOneColourShareAMaterial) {
    const GlbScene scene = read_scene(glb_of(model_of(small_design())));
    EXPECT_EQ(scene.materials, 7);  // white, two yellows, their white backs, blue lines, edges and folds
    const GlbNode& left = scene.nodes[static_cast<std::size_t>(node_named(scene, "e1/left"))];
    EXPECT_EQ(left.parts.at(0).color, (Point3{1.0, 0.603827, 0.0}));  // #ffcc00 as light
}

int plate_named(const Assembly& assembly, const std::string& name) {
    for (std::size_t i = 0; i < assembly.plates.size(); ++i) {
        if (assembly.plates[i].name == name) return static_cast<int>(i);
    }
    ADD_FAILURE() << "no plate " << name;
    return 0;
}

TEST(GltfLook, PlatesThatCrossAreOfAWarningMaterialAndSayWithWhatTheyCross) {
    using Json = nlohmann::json;
    GlbModel crossing = model_of(small_design());
    // Paper of the warning colour is not mistaken for a warning.
    crossing.assembly.plates[static_cast<std::size_t>(plate_named(crossing.assembly, "e1/right"))].fill =
        Color{255, 0, 0};
    GlbModel sound = crossing;
    sound.motion.examination.emplace();
    const auto plate = [&](const std::string& name) { return plate_named(crossing.assembly, name); };
    Examination& found = crossing.motion.examination.emplace();
    found.contacts.push_back(
        {plate("page/left"), plate("e1/left"), 12.34567, 80, 1.23456, 50, 0, plate("e1/left"), {}});
    found.contacts.push_back(
        {plate("e1/left"), plate("e3/right"), 0, 20.5, 0.25, 10, 0, plate("e1/left"), {}});
    const std::vector<SceneCard> cards{{&crossing.assembly, &crossing.motion, "bad:"},
                                       {&sound.assembly, &sound.motion, "good:"}};
    Diagnostics diagnostics;
    const Json model = Json::parse(write_gltf(cards, {}, diagnostics).value_or(""));

    std::map<std::string, Json> collisions;  // by plate, as its node has them
    for (const Json& node : model["nodes"]) {
        if (!node.contains("mesh")) continue;
        const std::string name = node["name"];
        EXPECT_EQ(node["extras"]["plate"], name);
        if (node["extras"].contains("collisions")) collisions[name] = node["extras"]["collisions"];
        const bool crosses = name == "bad:page/left" || name == "bad:e1/left" || name == "bad:e3/right";
        bool paper = true;  // the first part; then drawn lines
        bool drawn = false;
        for (const Json& part : model["meshes"][node["mesh"].get<std::size_t>()]["primitives"]) {
            const std::string material = model["materials"][part["material"].get<std::size_t>()]["name"];
            if (material == "edge" || material == "fold" || material.ends_with(" back")) continue;
            EXPECT_EQ(material == "collision", crosses && paper) << name << " " << material;
            EXPECT_EQ(material.ends_with(" line"), !paper) << name << " " << material;
            drawn = drawn || !paper;
            paper = false;
        }
        EXPECT_EQ(name.ends_with("page/left"), drawn) << name;
    }
    const auto row = [](const std::string& with, double from, double to, double depth) {
        return Json{{"with", with}, {"from_deg", from}, {"to_deg", to}, {"depth_mm", depth}};
    };
    const std::map<std::string, Json> expected{
        {"bad:page/left", Json::array({row("bad:e1/left", 12.346, 80, 1.2346)})},
        {"bad:e1/left",
         Json::array({row("bad:page/left", 12.346, 80, 1.2346), row("bad:e3/right", 0, 20.5, 0.25)})},
        {"bad:e3/right", Json::array({row("bad:e1/left", 0, 20.5, 0.25)})}};
    EXPECT_EQ(collisions, expected);
    std::size_t warnings = 0;
    for (const Json& material : model["materials"]) {
        if (material["name"] != "collision") continue;
        ++warnings;
        EXPECT_EQ(material["pbrMetallicRoughness"]["baseColorFactor"], Json::parse("[1.0, 0.0, 0.0, 1.0]"));
        EXPECT_EQ(material["doubleSided"], true);
    }
    EXPECT_EQ(warnings, 1U);
}

TEST(GltfLook, DrawnLinesLieBeforeTheirPlateAndAsWideAsDrawn) {
    GlbModel model = model_of(test::card(200, 100));
    Plate& right = model.assembly.plates[static_cast<std::size_t>(1)];
    ASSERT_EQ(right.name, "page/right");
    right.prints = {Stroke{{{10, 0}, {30, 0}}, 2.0, {255, 0, 0}},  // crossed by the next
                    Stroke{{{20, -10}, {20, 10}}, 2.0, {0, 0, 255}},
                    Stroke{{{90, 20}, {100, 20}}, 2.0, {0, 255, 0}}};  // ends on the edge: no round end there
    OutputOptions no_edges;
    no_edges.edge_lines = false;
    const GlbScene scene = read_scene(glb_of(model, no_edges));
    const GlbNode& node = scene.nodes[static_cast<std::size_t>(node_named(scene, "page/right"))];
    ASSERT_EQ(node.parts.size(), 4U);
    std::vector<double> areas;
    for (const auto& part : node.parts) {
        double sum = 0.0;
        for (const auto& t : part.triangles) {
            const Point3& a = part.points[t[0]];
            const Point3& b = part.points[t[1]];
            const Point3& c = part.points[t[2]];
            sum += 0.5e6 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
            for (const Point3* p : {&a, &b, &c}) {
                EXPECT_FLOAT_EQ(static_cast<float>((*p)[2]), areas.empty() ? 0.0F : 0.02e-3F);
                EXPECT_LE((*p)[0], 0.1 + 1e-8);
            }
        }
        areas.push_back(sum);
    }
    const double pi = std::acos(-1.0);
    EXPECT_NEAR(areas.at(1), 40 - 4 + pi, 0.1);
    EXPECT_NEAR(areas.at(2), 40 + pi, 0.1);
    EXPECT_NEAR(areas.at(3), 20 + 0.5 * pi, 0.1);
}

}  // namespace
}  // namespace popup
