// How cards stand in models: what is guessed, what is said, and that files are turned as they say.
#include "output/orientation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "assembly/orientation_names.h"
#include "output/gltf.h"
#include "output/keys.h"
#include "output/still/model.h"
#include "output/viewer/scene_json.h"
#include "support/designs.h"
#include "support/glb_models.h"

namespace popup {
namespace {

using test::add;
using test::card;
using test::GlbModel;
using test::model_of;
using test::Point3;

Design steps() {
    Design design = card();
    add(design, "step", {{-30, 60}, {-30, 90}, {20, 60}, {20, 90}});
    add(design, "step", {{-40, -60}, {-40, -20}, {25, -60}, {25, -20}});
    return design;
}

Design v_fold(double opens_deg = 180.0) {
    Design design = card();
    add(design, "v-fold", {{-60, 20}, {0, -20}, {60, 20}, {-62, 36}, {0, 0}, {62, 36}, {62, 80}, {-62, 80}});
    design.opens_deg = opens_deg;
    return design;
}

// "stage, guessed".
std::string stance(const Assembly& assembly) {
    const Stance found = stance_of(assembly);
    return std::string(kOrientationNames.at(static_cast<std::size_t>(found.orientation))) +
           (found.is_guessed ? ", guessed" : "");
}
std::string stance(const Design& design) { return stance(model_of(design).assembly); }

TEST(Orientation, IsGuessedByWhatRises) {
    EXPECT_EQ(stance(steps()), "stage, guessed");
    EXPECT_EQ(stance(v_fold()), "flat, guessed");
    Design tents = card();
    test::add_tent(tents, -30, 20, 25, 36);
    EXPECT_EQ(stance(tents), "flat, guessed");
    EXPECT_EQ(stance(card()), "upright, guessed");
    EXPECT_EQ(stance(v_fold(90.0)), "flat, guessed");
    Design opens_less = steps();
    opens_less.opens_deg = 90.0;
    EXPECT_EQ(stance(opens_less), "stage, guessed");
}

// Three fifths of the paper decide, not the number of pieces.
TEST(Orientation, IsThatOfMostOfThePaper) {
    Design both = v_fold();
    add(both, "step", {{-8, 85}, {-8, 95}, {5, 85}, {5, 95}});
    EXPECT_EQ(stance(both), "flat, guessed");
    both.structures.clear();
    add(both, "v-fold", {{-6, 52}, {0, 48}, {6, 52}, {-6.2, 4}, {0, 0}, {6.2, 4}, {6.2, 8}, {-6.2, 8}});
    add(both, "step", {{-40, -90}, {-40, -10}, {40, -90}, {40, -10}});
    EXPECT_EQ(stance(both), "stage, guessed");
}

TEST(Orientation, OfWhatLiesOnPagesIsThatOfAnEmptyCard) {
    const test::FromXml made = test::from_xml(R"(
    <structure type="attached-plane" id="leaf">
      <outerpoints>
        <point x="20" y="-20"/><point x="20" y="20"/><point x="0" y="0"/><point x="0" y="40"/>
      </outerpoints>
      <outline d="M 0 0 H 30 V 40 H 0 Z"/>
      <parentplate page="0" x="40" y="0"/>
    </structure>)");
    ASSERT_TRUE(made.assembly) << made.text;
    ASSERT_EQ(made.assembly->glued_areas.size(), 1U);
    EXPECT_EQ(stance(*made.assembly), "upright, guessed");
}

TEST(Orientation, IsWhatTheAssemblySaysWhereItCanBe) {
    Assembly assembly = model_of(steps()).assembly;
    for (const Orientation said : {Orientation::upright, Orientation::flat, Orientation::stage}) {
        assembly.orientation = said;
        EXPECT_EQ(stance_of(assembly).orientation, said);
        EXPECT_FALSE(stance_of(assembly).is_guessed);
    }
    assembly.covers.pop_back();  // a stage has a ground and a wall
    EXPECT_EQ(stance(assembly), "flat, guessed");
    Assembly parts;  // z is up where nothing moves
    parts.orientation = Orientation::upright;
    EXPECT_EQ(stance(parts), "flat, guessed");
}

// Where a card stands in a file: directions of its right page and its left one, in the world.
struct Told {
    Point3 ground_x{}, ground_y{}, ground_up{}, wall_x{}, wall_front{};
};
Told at(const test::GlbScene& scene, double deg) {
    const auto poses = test::pose_at_angle(scene, deg);
    const auto& ground = poses.at(static_cast<std::size_t>(test::node_named(scene, "page/right")));
    const auto& wall = poses.at(static_cast<std::size_t>(test::node_named(scene, "page/left")));
    return {ground.axes[0], ground.axes[1], ground.axes[2], wall.axes[0], wall.axes[2]};
}
void expect_near(const Point3& a, const Point3& b, const std::string& what) {
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(a.at(i), b.at(i), 1e-5) << what << ", axis " << i;
}

test::GlbScene scene_of(Design design, Orientation orientation) {
    design.orientation = orientation;
    return test::read_scene(test::glb_of(model_of(design)));
}

// The right page lies on the ground at all openings, its outer edge in front; half open the left one faces
// the viewer, its outer edge above.
TEST(Orientation, StagesKeepTheirGroundLevel) {
    const test::GlbScene scene = scene_of(steps(), Orientation::guessed);
    for (const double deg : {1.0, 33.3, 60.0, 90.0, 123.4, 180.0}) {
        const Told told = at(scene, deg);
        const std::string where = std::to_string(deg);
        expect_near(told.ground_up, {0, 1, 0}, "up at " + where);
        expect_near(told.ground_x, {0, 0, 1}, "to the viewer at " + where);
        expect_near(told.ground_y, {1, 0, 0}, "right at " + where);
    }
    expect_near(at(scene, 90.0).wall_front, {0, 0, 1}, "wall");
    expect_near(at(scene, 90.0).wall_x, {0, -1, 0}, "edge of the wall above");
    const auto poses = test::rest_pose(scene);
    const auto ground = static_cast<std::size_t>(test::node_named(scene, "page/right"));
    expect_near(poses.at(ground).axes[2], {0, 1, 0}, "at rest");
}

TEST(Orientation, FlatAndUprightCardsAreTurnedOnce) {
    const Told flat = at(scene_of(v_fold(), Orientation::guessed), 180.0);
    expect_near(flat.ground_up, {0, 1, 0}, "flat");
    expect_near(flat.ground_y, {0, 0, -1}, "the head of the page is away");
    const Told upright = at(scene_of(v_fold(), Orientation::upright), 180.0);
    expect_near(upright.ground_up, {0, 0, 1}, "upright");
    expect_near(upright.ground_y, {0, 1, 0}, "the head of the page is above");
}

nlohmann::json root_extras(const Design& design) {
    const GlbModel model = model_of(design);
    const SceneCard one{&model.assembly, &model.motion, {}};
    Diagnostics diagnostics;
    const auto text = write_gltf({&one, 1}, {}, diagnostics);
    if (!text) return {};
    const auto json = nlohmann::json::parse(*text);
    return json["nodes"][json["scenes"][0]["nodes"][0].get<std::size_t>()]["extras"];
}

TEST(Orientation, IsToldInTheModel) {
    EXPECT_EQ(root_extras(steps()).dump(), R"({"orientation":"stage","orientation_guessed":true})");
    Design said = steps();
    said.orientation = Orientation::upright;
    EXPECT_EQ(root_extras(said).dump(), R"({"orientation":"upright"})");
}

// The model rests as far open as pictures show it.
TEST(Orientation, ModelsRestWherePicturesAreTaken) {
    for (const auto& [design, deg] : {std::pair{v_fold(), 130.0}, std::pair{steps(), 90.0}}) {
        const GlbModel model = model_of(design);
        const SceneCard one{&model.assembly, &model.motion, {}};
        EXPECT_EQ(still::Modeller({&one, 1}, false).best_deg(), deg);
        const test::GlbScene scene = test::read_scene(test::glb_of(model));
        const auto rest = test::rest_pose(scene);
        const auto there = test::pose_at_angle(scene, deg);
        for (std::size_t i = 0; i < rest.size(); ++i) expect_near(rest[i].axes[0], there[i].axes[0], "rest");
    }
}

// The same directions in pictures, z up: who looks from before has x on the right.
TEST(Orientation, IsThatOfPicturesToo) {
    const GlbModel model = model_of(steps());
    std::vector<Frame> frames(model.assembly.plates.size());
    const auto right = static_cast<std::size_t>(model.assembly.covers.back());
    const auto normal = [&](Orientation orientation, double deg) {
        EXPECT_TRUE(place(model.assembly, Angle::degrees(deg), frames));
        stand(orientation, model.assembly, frames);
        const Vec3 n = frames[right].normal();
        return Point3{n.x, n.y, n.z};
    };
    expect_near(normal(Orientation::stage, 50.0), {0, 0, 1}, "stage");
    expect_near(normal(Orientation::flat, 180.0), {0, 0, 1}, "flat");
    expect_near(normal(Orientation::upright, 180.0), {0, -1, 0}, "upright");
}

TEST(Orientation, IsToldToTheViewer) {
    const auto row = [](Design design, Orientation orientation) {
        design.orientation = orientation;
        const GlbModel model = model_of(design);
        const SceneCard one{&model.assembly, &model.motion, {}};
        Diagnostics diagnostics;
        const auto keys = choose_keys({&one, 1}, {}, diagnostics);
        return viewer_scene({&one, 1}, keys.value(), still::Modeller({&one, 1}, false), {})["cards"][0];
    };
    EXPECT_TRUE(row(steps(), Orientation::guessed).contains("ground"));
    EXPECT_FALSE(row(steps(), Orientation::guessed).contains("upright"));
    EXPECT_EQ(row(steps(), Orientation::upright)["upright"], true);
    EXPECT_FALSE(row(steps(), Orientation::upright).contains("ground"));
    EXPECT_FALSE(row(v_fold(), Orientation::guessed).contains("upright"));
}

}  // namespace
}  // namespace popup
