// A crease pattern as it is folded, for tests of what is shown of it.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <optional>
#include <vector>

#include "popup/crease_pattern.h"
#include "popup/motion.h"
#include "popup/output.h"
#include "support/designs.h"
#include "support/folded_ends.h"

namespace popup::test {

struct FoldedSheet {
    std::optional<Assembly> assembly;
    std::optional<Motion> motion;

    explicit FoldedSheet(const CreasePattern& pattern) {
        Diagnostics diagnostics;
        assembly = fold_sheet(pattern, {}, diagnostics);
        if (assembly) motion = simulate(*assembly, {}, diagnostics);
        EXPECT_TRUE(assembly && motion) << findings(diagnostics);
    }
    [[nodiscard]] std::vector<Frame> at(double deg) const {
        std::vector<Frame> frames(assembly->plates.size());
        EXPECT_TRUE(place(*assembly, Angle::degrees(deg), frames));
        return frames;
    }
    [[nodiscard]] SceneCard card() const { return {&*assembly, &*motion, {}}; }
    // The plate with this point of the drawing on it.
    [[nodiscard]] std::size_t plate_at(Vec2 p) const {
        for (std::size_t i = 0; i < assembly->plates.size(); ++i) {
            if (contains(assembly->plates[i].outline, p)) return i;
        }
        ADD_FAILURE() << "no panel there";
        return 0;
    }
};

// Four walls and a flap that comes to lie on the first one, all folded by a right angle: a tube without any
// allowance.
inline CreasePattern tube(CreaseUse use) {
    CreasePattern pattern;
    add_line(pattern, {{0, 0}, {175, 0}, {175, 30}, {0, 30}}, true, CreaseUse::cut);
    for (const double x : {50.0, 80.0, 130.0, 160.0}) add_line(pattern, {{x, 0}, {x, 30}}, false, use, 90.0);
    return pattern;
}

}  // namespace popup::test
