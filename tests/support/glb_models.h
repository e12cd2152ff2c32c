// Small designs as models, read back.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "output/gltf.h"
#include "support/designs.h"
#include "support/glb_scene.h"

namespace popup::test {

struct GlbModel {
    Assembly assembly;
    Motion motion;
};

// Not examined: what a test wants to be found, it says itself.
inline GlbModel model_of(const Design& design, MotionOptions options = {}) {
    options.examine = false;
    Built built = build(design);
    GlbModel model{std::move(*built.assembly), {}};
    auto motion = simulate(model.assembly, options, built.diagnostics);
    if (!motion) ADD_FAILURE() << findings(built.diagnostics);
    if (motion) model.motion = *motion;
    return model;
}

inline std::string glb_of(const GlbModel& model, const OutputOptions& options = {},
                          const std::string& prefix = {}) {
    const SceneCard card{&model.assembly, &model.motion, prefix};
    Diagnostics diagnostics;
    const auto bytes = write_glb({&card, 1}, options, diagnostics);
    EXPECT_TRUE(bytes.has_value()) << findings(diagnostics);
    EXPECT_FALSE(diagnostics.has_findings()) << findings(diagnostics);
    return bytes.value_or("");
}

inline GlbScene read_scene(const std::string& bytes) {
    std::string error;
    auto scene = read_glb(bytes, &error);
    EXPECT_TRUE(scene.has_value()) << error;
    return scene.value_or(GlbScene{});
}

inline int node_named(const GlbScene& scene, const std::string& name) {
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        if (scene.nodes[i].name == name) return static_cast<int>(i);
    }
    ADD_FAILURE() << "no node " << name;
    return 0;
}

// A v-fold on the gutter whose plates turn through large angles, and a step on either side of it.
inline Design small_design() {
    Design design = card();
    add(design, "v-fold", {{-60, 20}, {0, -20}, {60, 20}, {-62, 36}, {0, 0}, {62, 36}, {62, 80}, {-62, 80}});
    design.structures.back().argument(0).value = Color{255, 204, 0};  // of the left half
    design.structures.back().argument(1).value = Color{255, 153, 0};  // and of the right one
    add(design, "step", {{-30, 60}, {-30, 90}, {20, 60}, {20, 90}});
    add(design, "beak", {{0, -30}, {-30, -60}, {30, -60}});
    DrawnLine line;
    line.thickness_pt = 72.0 / 25.4 * 2.0;
    line.color = {0, 0, 255};
    line.points.resize(2);
    line.points[0].at = {-120, -90};
    line.points[1].at = {-100, -90};
    design.lines.push_back(line);
    return design;
}

}  // namespace popup::test
