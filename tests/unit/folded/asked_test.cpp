// Closed shapes of which the drawing gives all angles.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "popup/crease_pattern.h"
#include "popup/refinement.h"
#include "support/designs.h"
#include "support/folded_ends.h"

namespace popup {
namespace {

using test::add_line;
using test::ends_of;
using test::told;

// The gable of a milk carton, a part of it: two walls and a gusset between them, with a fin above.
CreasePattern gable(double deg = 51.05756, double slope = 127.22440) {
    CreasePattern gable;
    add_line(gable, {{10, 10}, {180, 10}, {180, 127}, {10, 127}}, true, CreaseUse::cut);
    for (const double x : {60.0, 130.0}) {
        add_line(gable, {{x, 67}, {x, 127}}, false, CreaseUse::mountain, 90.0);
        add_line(gable, {{x, 22}, {x, 67}}, false, CreaseUse::mountain, 180.0);
        add_line(gable, {{x, 10}, {x, 22}}, false, CreaseUse::mountain, 180.0);
    }
    add_line(gable, {{10, 67}, {180, 67}}, false, CreaseUse::mountain, deg);
    add_line(gable, {{60, 22}, {130, 22}}, false, CreaseUse::mountain, deg);
    add_line(gable, {{60, 67}, {95, 22}, {130, 67}}, false, CreaseUse::valley, slope);
    add_line(gable, {{95, 10}, {95, 22}}, false, CreaseUse::valley, 180.0);
    add_line(gable, {{10, 22}, {60, 22}}, false, CreaseUse::valley, deg);
    add_line(gable, {{130, 22}, {180, 22}}, false, CreaseUse::valley, deg);
    return gable;
}

TEST(ClosedAsAsked, IsTheShapeWhoseAnglesAreAllGivenAndClose) {
    Diagnostics diagnostics("gable");
    const CreasePattern drawn = gable();
    const auto folded = fold_sheet(drawn, {}, diagnostics);
    ASSERT_TRUE(folded);
    EXPECT_TRUE(told(diagnostics, "fold-stays-flat").empty()) << test::findings(diagnostics);
    EXPECT_EQ(told(diagnostics, "no-rigid-way").size(), 1U) << test::findings(diagnostics);
    EXPECT_TRUE(folded->sweep.bends);
    for (const auto& [deg, count] : ends_of(*folded)) {
        const double size = std::abs(deg);
        EXPECT_TRUE(std::abs(size - 90.0) < 0.01 || std::abs(size - 180.0) < 0.01 ||
                    std::abs(size - 51.058) < 0.01 || std::abs(size - 127.224) < 0.01)
            << count << " of " << deg;
    }
    // No loop gapes there, and suggestions and edits begin from it.
    Diagnostics of_shape;
    const auto shape = refine_shape(drawn, {}, of_shape);
    ASSERT_TRUE(shape) << test::findings(of_shape);
    EXPECT_TRUE(shape->closes) << shape->residual_mm;
    Diagnostics of_suggestions;
    EXPECT_TRUE(suggest_joins(drawn, {}, of_suggestions)) << test::findings(of_suggestions);
}

TEST(ClosedAsAsked, IsNotWhatDoesNotClose) {
    Diagnostics diagnostics("gable");
    ASSERT_TRUE(fold_sheet(gable(53.0), {}, diagnostics));
    EXPECT_TRUE(told(diagnostics, "no-rigid-way").empty());
    EXPECT_TRUE(diagnostics.has_findings());
}

}  // namespace
}  // namespace popup
