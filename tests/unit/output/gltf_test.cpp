#include "output/gltf.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "support/glb_models.h"
#include "support/run_program.h"

namespace popup {
namespace {

using test::glb_of;
using test::GlbModel;
using test::GlbNode;
using test::GlbScene;
using test::model_of;
using test::node_named;
using test::Point3;
using test::read_scene;
using test::small_design;

double mm_between(const Point3& a, const Point3& b) {
    return 1000.0 * std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

std::vector<std::pair<std::string, Design>> designs() {
    std::vector<std::pair<std::string, Design>> all;
    all.emplace_back("empty card", test::card());
    all.emplace_back("small", small_design());
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
        all.emplace_back("seed " + std::to_string(seed), test::generate(seed, 26));
    }
    return all;
}

// A hinge's end on both its plates, as points of their nodes: page coordinates from the plate's pivot, in
// metres.
std::vector<test::GlbJoint> joints_of(const Assembly& assembly, const GlbScene& scene) {
    const auto local = [&assembly](int plate, Vec2 p) {
        const Vec2 d = p - assembly.plates[static_cast<std::size_t>(plate)].pivot;
        return Point3{d.x / 1000.0, d.y / 1000.0, 0.0};
    };
    std::vector<test::GlbJoint> joints;
    for (const Hinge& hinge : assembly.hinges) {
        const int a = node_named(scene, assembly.plates[static_cast<std::size_t>(hinge.a)].name);
        const int b = node_named(scene, assembly.plates[static_cast<std::size_t>(hinge.b)].name);
        joints.push_back({a, b, local(hinge.a, hinge.a_line.a), local(hinge.b, hinge.b_line.a)});
        joints.push_back({a, b, local(hinge.a, hinge.a_line.b), local(hinge.b, hinge.b_line.b)});
    }
    return joints;
}

TEST(Gltf, HingesStayClosedAtTheKeysAndBetweenThem) {
    for (const auto& [name, design] : designs()) {
        const GlbModel model = model_of(design);
        const GlbScene scene = read_scene(glb_of(model));
        const auto open = test::measure_openings(scene, joints_of(model.assembly, scene));
        EXPECT_LE(open.at_keys_mm, 0.001) << name;
        EXPECT_LE(open.between_keys_mm, 0.05) << name << " at " << open.at_deg << "°";
    }
}

TEST(Gltf, HingesStayClosedWithFewSampledAnglesAndLargePages) {
    MotionOptions options;
    options.angles = {Angle::degrees(10), Angle::degrees(170)};
    Design design = test::card(2794, 2159);
    test::add(design, "v-fold",
              {{-600, 200}, {0, -200}, {600, 200}, {-620, 360}, {0, 0}, {620, 360}, {620, 800}, {-620, 800}});
    const GlbModel model = model_of(design, options);
    const GlbScene scene = read_scene(glb_of(model));
    const auto open = test::measure_openings(scene, joints_of(model.assembly, scene));
    EXPECT_LE(open.at_keys_mm, 0.001);
    EXPECT_LE(open.between_keys_mm, 0.05) << open.at_deg << "°";
}

TEST(Gltf, TheMeshesThemselvesMeetWhereHingesAre) {
    // By the meshes alone: corners that lie on another plate all the way.
    const GlbModel model = model_of(small_design());
    const GlbScene scene = read_scene(glb_of(model));
    const auto joints = test::find_joints(scene);
    std::set<std::pair<int, int>> joined;
    for (const auto& joint : joints) joined.insert(std::minmax(joint.a, joint.b));
    for (const Hinge& hinge : model.assembly.hinges) {
        const std::string& a = model.assembly.plates[static_cast<std::size_t>(hinge.a)].name;
        const std::string& b = model.assembly.plates[static_cast<std::size_t>(hinge.b)].name;
        EXPECT_TRUE(joined.contains(std::minmax(node_named(scene, a), node_named(scene, b))))
            << a << " and " << b;
    }
    const auto open = test::measure_openings(scene, joints);
    EXPECT_LE(open.at_keys_mm, 0.001);
    EXPECT_LE(open.between_keys_mm, 0.05);
}

TEST(Gltf, BasePlanesOpenEvenlyAboutTheSpine) {
    // x = ±c sin(θ/2), z = c cos(θ/2): the corners of an 11 × 8.5 inch card.
    const GlbScene scene = read_scene(glb_of(model_of(test::card())));
    for (const double deg : {0.0, 1.0, 37.5, 90.0, 123.4, 180.0}) {
        const auto poses = test::pose_at_angle(scene, deg);
        const double half = deg * std::acos(-1.0) / 360.0;
        for (const auto& [name, side] : {std::pair{"page/left", -1.0}, std::pair{"page/right", 1.0}}) {
            const auto i = static_cast<std::size_t>(node_named(scene, name));
            double nearest = HUGE_VAL;
            const Point3 wanted{side * 0.1397 * std::sin(half), 0.10795, 0.1397 * std::cos(half)};
            for (const Point3& p : scene.nodes[i].parts.at(0).points) {
                nearest = std::min(nearest, mm_between(poses[i].point(p), wanted));
            }
            EXPECT_LT(nearest, 0.001) << name << " at " << deg << "°";
        }
    }
}

TEST(Gltf, PlatesAreWhereTheClosedFormPutsThemAndRestOpenAt90Degrees) {
    GlbModel model = model_of(small_design());
    model.assembly.orientation = Orientation::upright;  // others are turned: orientation_test.cpp
    const GlbScene scene = read_scene(glb_of(model));
    const auto compare = [&](const std::vector<test::GlbPose>& poses, double deg) {
        std::vector<Frame> frames(model.assembly.plates.size());
        ASSERT_TRUE(place(model.assembly, Angle::degrees(deg), frames));
        for (std::size_t i = 0; i < frames.size(); ++i) {
            const Plate& plate = model.assembly.plates[i];
            const auto node = static_cast<std::size_t>(node_named(scene, plate.name));
            for (const Vec2 p : plate.outline.outer) {
                const Vec3 wanted = frames[i].point(p);
                const Vec2 d = p - plate.pivot;
                EXPECT_LT(mm_between(poses[node].point({d.x / 1000, d.y / 1000, 0}),
                                     {wanted.x / 1000, wanted.y / 1000, wanted.z / 1000}),
                          0.001)
                    << plate.name << " at " << deg << "°";
            }
        }
    };
    for (const double deg : {0.0, 45.0, 90.0, 135.0, 180.0}) compare(test::pose_at_angle(scene, deg), deg);
    compare(test::rest_pose(scene), 90.0);
}

TEST(Gltf, NodesAreNamedByPlateAndCarryPlateAndPiece) {
    const GlbModel model = model_of(small_design());
    const GlbScene plain = read_scene(glb_of(model));
    const GlbScene prefixed = read_scene(glb_of(model, {}, "castle:"));
    EXPECT_EQ(plain.nodes.at(0).name, "card");
    EXPECT_EQ(prefixed.nodes.at(0).name, "castle");
    ASSERT_EQ(plain.nodes.size(), model.assembly.plates.size() + 1);
    for (const Plate& plate : model.assembly.plates) {
        const GlbNode& node = plain.nodes[static_cast<std::size_t>(node_named(plain, plate.name))];
        EXPECT_EQ(node.plate, plate.name);
        EXPECT_EQ(node.piece, model.assembly.pieces[static_cast<std::size_t>(plate.piece)].name);
        const GlbNode& other =
            prefixed.nodes[static_cast<std::size_t>(node_named(prefixed, "castle:" + plate.name))];
        EXPECT_EQ(other.plate, "castle:" + plate.name);
        EXPECT_EQ(other.piece, "castle:" + node.piece);
    }
}

TEST(Gltf, NodesFormTheHingeTree) {
    const GlbModel model = model_of(small_design());
    const GlbScene scene = read_scene(glb_of(model));
    for (const Plate& plate : model.assembly.plates) {
        const GlbNode& node = scene.nodes[static_cast<std::size_t>(node_named(scene, plate.name))];
        const std::string parent =
            plate.parent < 0 ? "card" : model.assembly.plates[static_cast<std::size_t>(plate.parent)].name;
        ASSERT_GE(node.parent, 0);
        EXPECT_EQ(scene.nodes[static_cast<std::size_t>(node.parent)].name, parent) << plate.name;
    }
    EXPECT_EQ(scene.nodes.at(0).parent, -1);
}

TEST(Gltf, KeysIncludeTheSampledAnglesAndTimeGrowsWithTheAngle) {
    MotionOptions motion;
    motion.angles = {Angle::degrees(12.5), Angle::degrees(63), Angle::degrees(63.01)};
    OutputOptions options;
    options.duration_s = 3.0;
    const GlbScene scene = read_scene(glb_of(model_of(small_design(), motion), options));
    for (const double wanted : {0.0, 12.5, 63.0, 63.01, 90.0, 180.0}) {
        EXPECT_TRUE(std::binary_search(scene.angles_deg.begin(), scene.angles_deg.end(), wanted)) << wanted;
    }
    ASSERT_EQ(scene.times.size(), scene.angles_deg.size());
    EXPECT_EQ(scene.times.front(), 0.0);
    EXPECT_EQ(scene.times.back(), 3.0);
    for (std::size_t i = 0; i < scene.times.size(); ++i) {
        EXPECT_NEAR(scene.times[i], 3.0 * scene.angles_deg[i] / 180.0, 1e-6);
        if (i > 0) {
            EXPECT_GT(scene.times[i], scene.times[i - 1]);
        }
    }
}

TEST(Gltf, FramesASecondAddKeys) {
    OutputOptions options;
    options.fps = 60.0;
    options.duration_s = 2.0;
    const GlbScene scene = read_scene(glb_of(model_of(test::card()), options));
    for (std::size_t i = 1; i < scene.times.size(); ++i) {
        EXPECT_LE(scene.times[i] - scene.times[i - 1], 1.0 / 60.0 + 1e-5);
    }
}

TEST(Gltf, AnglesThatFallOnOneTimeGiveOneKey) {
    MotionOptions motion;
    motion.angles = {Angle::degrees(0),         Angle::degrees(1e-6),       Angle::degrees(40),
                     Angle::degrees(40.000001), Angle::degrees(179.999999), Angle::degrees(180)};
    const GlbScene scene = read_scene(glb_of(model_of(test::card(), motion)));
    EXPECT_EQ(scene.angles_deg, (std::vector<double>{0, 40, 90, 180}));
    for (std::size_t i = 1; i < scene.times.size(); ++i) EXPECT_GT(scene.times[i], scene.times[i - 1]);
}

TEST(Gltf, TurnsGoTheShortWayAndHoldNoNegativeZero) {
    for (const auto& [name, design] : designs()) {
        const GlbScene scene = read_scene(glb_of(model_of(design)));
        for (const GlbNode& node : scene.nodes) {
            for (std::size_t i = 0; i < node.turns.size(); ++i) {
                double product = 0.0;
                for (std::size_t k = 0; k < 4; ++k) {
                    const double value = node.turns[i].at(k);
                    EXPECT_FALSE(value == 0.0 && std::signbit(value)) << name << ", " << node.name;
                    product += value * node.turns[i == 0 ? 0 : i - 1].at(k);
                }
                EXPECT_GT(product, 0.0) << name << ", " << node.name << " at " << scene.angles_deg[i] << "°";
            }
            for (const auto& part : node.parts) {
                for (const Point3& p : part.points) {
                    for (const double value : p) EXPECT_FALSE(value == 0.0 && std::signbit(value));
                }
            }
        }
    }
}

TEST(Gltf, TheSameModelGivesTheSameBytes) {
    const Design design = test::generate(7, 26);
    EXPECT_EQ(glb_of(model_of(design)), glb_of(model_of(design)));
}

TEST(Gltf, AnExaminationThatFindsNoCrossingChangesNoByte) {
    GlbModel model = model_of(small_design());
    const std::string without = glb_of(model);
    model.motion.examination.emplace().closed.max_layers = 9;
    EXPECT_EQ(glb_of(model), without);
}

TEST(Gltf, CardsStandSideBySideTwentyMillimetresApart) {
    const GlbModel wide = model_of(test::card(200, 100));
    const GlbModel narrow = model_of(test::card(60, 100));
    const std::vector<SceneCard> cards{{&wide.assembly, &wide.motion, "wide:"},
                                       {&narrow.assembly, &narrow.motion, "narrow:"},
                                       {&wide.assembly, &wide.motion, "wide~2:"}};
    Diagnostics diagnostics;
    const GlbScene scene = read_scene(write_glb(cards, {}, diagnostics).value_or(""));
    const auto open = test::pose_at_angle(scene, 180.0);
    const auto x_of = [&](const std::string& name, double side) {
        const auto i = static_cast<std::size_t>(node_named(scene, name));
        double x = -HUGE_VAL;
        for (const Point3& p : scene.nodes[i].parts.at(0).points) x = std::max(x, side * open[i].point(p)[0]);
        return 1000 * side * x;
    };
    EXPECT_NEAR(x_of("wide:page/left", -1), -100, 1e-4);
    EXPECT_NEAR(x_of("narrow:page/left", -1) - x_of("wide:page/right", 1), 20, 1e-4);
    EXPECT_NEAR(x_of("wide~2:page/left", -1) - x_of("narrow:page/right", 1), 20, 1e-4);
}

TEST(Gltf, CardsWithDifferentKeysKeepTheirPromisesTogether) {
    MotionOptions few;
    few.angles = {Angle::degrees(17)};
    const GlbModel a = model_of(small_design(), few);
    const GlbModel b = model_of(test::generate(3, 10));
    const std::vector<SceneCard> cards{{&a.assembly, &a.motion, "a:"}, {&b.assembly, &b.motion, "b:"}};
    Diagnostics diagnostics;
    const GlbScene scene = read_scene(write_glb(cards, {}, diagnostics).value_or(""));
    const auto open = test::measure_openings(scene, test::find_joints(scene));
    EXPECT_LE(open.at_keys_mm, 0.001);
    EXPECT_LE(open.between_keys_mm, 0.05);
    EXPECT_TRUE(std::binary_search(scene.angles_deg.begin(), scene.angles_deg.end(), 17.0));
}

TEST(Gltf, TheIterativeSolverMovesTheModelToo) {
    MotionOptions options;
    options.solver = Solver::iterative;
    options.angles = {Angle::degrees(0), Angle::degrees(60), Angle::degrees(120), Angle::degrees(180)};
    const GlbModel model = model_of(small_design(), options);
    const GlbScene scene = read_scene(glb_of(model));
    const auto open = test::measure_openings(scene, joints_of(model.assembly, scene));
    EXPECT_GT(open.at_keys_mm, 1e-5);  // its own inaccuracy is there to be seen
    EXPECT_LT(open.at_keys_mm, 5.0);
}

TEST(Gltf, NamesThatAreNoUtf8AreMended) {
    const GlbScene scene = read_scene(glb_of(model_of(test::card()), {}, "caf\xE9\xED\xA0\x80:"));
    EXPECT_EQ(scene.nodes.at(0).name, "caf\uFFFD\uFFFD\uFFFD\uFFFD");
}

TEST(Gltf, PlatesThatDoNotMoveHaveNoChannel) {
    GlbModel model = model_of(test::card());
    model.assembly.pieces.push_back({"leaf", {2}});
    Plate leaf;
    leaf.name = "leaf";
    leaf.piece = 1;
    leaf.outline.outer = {{0, 0}, {10, 0}, {0, 10}};
    model.assembly.plates.push_back(leaf);
    const GlbScene scene = read_scene(glb_of(model));
    EXPECT_EQ(scene.channels, 2);
    EXPECT_TRUE(scene.nodes[static_cast<std::size_t>(node_named(scene, "leaf"))].turns.empty());
}

TEST(Gltf, TooManyKeysAreAnErrorWithTheNumbers) {
    const GlbModel model = model_of(test::card());
    const SceneCard card{&model.assembly, &model.motion, ""};
    OutputOptions options;
    options.fps = 1e9;
    Diagnostics diagnostics;
    EXPECT_FALSE(write_glb({&card, 1}, options, diagnostics).has_value());
    EXPECT_EQ(test::findings(diagnostics),
              "error model-too-large: the animation would have 4000000000 keys for 2 plates, 100000 keys "
              "are the most\n");
}

TEST(Gltf, TheTextFormHoldsTheSameModel) {
    const GlbModel model = model_of(small_design());
    const SceneCard card{&model.assembly, &model.motion, ""};
    Diagnostics diagnostics;
    const std::string text = write_gltf({&card, 1}, {}, diagnostics).value_or("");
    EXPECT_NE(text.find("\"uri\": \"data:application/octet-stream;base64,"), std::string::npos);
    EXPECT_NE(text.find("\"generator\": \"popupc "), std::string::npos);
    const std::string binary = glb_of(model);
    std::uint32_t json_size = 0;
    std::memcpy(&json_size, binary.data() + 12, 4);
    EXPECT_EQ(binary.substr(0, 4), "glTF");
    EXPECT_EQ(binary.size() % 4, 0U);
    EXPECT_EQ(json_size % 4, 0U);
}

// An accordion: each strip pair is hinged to the one before, one millimetre on.
Assembly accordion(int pairs) {
    Assembly assembly = test::build(test::card(100, 20)).assembly.value_or(Assembly{});
    for (int i = 0; i < pairs; ++i) {
        const int left = i == 0 ? 0 : static_cast<int>(assembly.plates.size()) - 2;
        const int here = static_cast<int>(assembly.plates.size());
        assembly.pieces.push_back({"p" + std::to_string(i), {here, here + 1}});
        const std::string name = "p" + std::to_string(i);
        FourBar bars;
        bars.parallel = true;
        for (const int side : {0, 1}) {
            // The plate lies between its seam at x = 0 and its centre fold at x = 1 (left) or -1 (right).
            const double to_centre = side == 0 ? 1.0 : -1.0;
            Plate plate;
            plate.name = name + (side == 0 ? "/left" : "/right");
            plate.piece = i + 1;
            plate.outline.outer = {{std::min(0.0, to_centre), 0},
                                   {std::max(0.0, to_centre), 0},
                                   {std::max(0.0, to_centre), 1},
                                   {std::min(0.0, to_centre), 1}};
            plate.parent = left + side;
            assembly.plates.push_back(plate);
            Bar& bar = side == 0 ? bars.left : bars.right;
            bar.drive = left + side;
            bar.plate = here + side;
            bar.fold_dir = bar.seam_dir = bar.own_seam = {0, 1};
            // The first stands on the page, whose fold is at x = 0; the others on the plates before.
            bar.fold_at = {i == 0 ? 0.0 : to_centre, 0};
            bar.fold_out = {-to_centre, 0};
            bar.seam_at = bar.fold_at + bar.fold_out;
            bar.own_centre = {to_centre, 0};
            bar.near = bar.far = 1.0;
        }
        assembly.hinges.push_back({here, here + 1, {{1, 0}, {1, 1}}, {{-1, 0}, {-1, 1}}, false});
        assembly.joints.push_back({name, {}, bars});
    }
    return assembly;
}

TEST(Gltf, AChainOfTenThousandPlatesNeedsNoDeepStack) {
    MotionOptions options;
    options.angles = {Angle::degrees(0), Angle::degrees(180)};
    GlbModel model{accordion(10000), {}};
    model.motion.angles = options.angles;
    const GlbScene scene = read_scene(glb_of(model));
    EXPECT_EQ(scene.nodes.size(), 20003U);
}

TEST(Gltf, KhronosValidatorFindsNothing) {
    if (std::getenv("POPUP_GLTF_VALIDATOR") == nullptr || !test::have_program("node")) {
        GTEST_SKIP() << "POPUP_GLTF_VALIDATOR does not say where gltf-validator is, or there is no node";
    }
    const test::ScratchDirectory scratch;
    for (const auto& [name, design] : designs()) {
        const GlbModel model = model_of(design);
        const SceneCard card{&model.assembly, &model.motion, ""};
        Diagnostics diagnostics;
        test::write_file(scratch / "model.glb", glb_of(model));
        test::write_file(scratch / "model.gltf", write_gltf({&card, 1}, {}, diagnostics).value_or(""));
        const auto result =
            test::run({"node", std::string(POPUP_SOURCE_DIR) + "/tests/tools/validate_gltf.mjs",
                       (scratch / "model.glb").string(), (scratch / "model.gltf").string()});
        EXPECT_EQ(result.exit, 0) << name << "\n" << result.out << result.err;
    }
}

}  // namespace
}  // namespace popup
