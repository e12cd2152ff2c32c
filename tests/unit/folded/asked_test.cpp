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

namespace popup {
namespace {

void add(CreasePattern& pattern, std::vector<Vec2> points, bool closed, CreaseUse use, double deg = 90.0) {
    CreaseLine line;
    line.points = std::move(points);
    line.closed = closed;
    line.use = use;
    line.fold_deg = deg;
    pattern.lines.push_back(std::move(line));
}

// How many folds end at an angle, degrees, mountains below 0; to a thousandth.
std::map<double, int> ends_of(const Assembly& assembly) {
    std::map<double, int> ends;
    for (const Line& line : assembly.lines) {
        if (line.kind != LineKind::mountain && line.kind != LineKind::valley) continue;
        const double deg = line.fold_angle.value_or(0.0) * 180.0 / 3.14159265358979;
        ++ends[std::round((line.kind == LineKind::mountain ? -deg : deg) * 1e3) / 1e3];
    }
    return ends;
}

std::vector<Diagnostic> told(const Diagnostics& diagnostics, const std::string& code) {
    std::vector<Diagnostic> found;
    for (const Diagnostic& one : diagnostics.sorted()) {
        if (one.code == code) found.push_back(one);
    }
    return found;
}

// The gable of a milk carton, a part of it: two walls and a gusset between them, with a fin above.
CreasePattern gable(double deg = 51.05756, double slope = 127.22440) {
    CreasePattern gable;
    add(gable, {{10, 10}, {180, 10}, {180, 127}, {10, 127}}, true, CreaseUse::cut);
    for (const double x : {60.0, 130.0}) {
        add(gable, {{x, 67}, {x, 127}}, false, CreaseUse::mountain, 90.0);
        add(gable, {{x, 22}, {x, 67}}, false, CreaseUse::mountain, 180.0);
        add(gable, {{x, 10}, {x, 22}}, false, CreaseUse::mountain, 180.0);
    }
    add(gable, {{10, 67}, {180, 67}}, false, CreaseUse::mountain, deg);
    add(gable, {{60, 22}, {130, 22}}, false, CreaseUse::mountain, deg);
    add(gable, {{60, 67}, {95, 22}, {130, 67}}, false, CreaseUse::valley, slope);
    add(gable, {{95, 10}, {95, 22}}, false, CreaseUse::valley, 180.0);
    add(gable, {{10, 22}, {60, 22}}, false, CreaseUse::valley, deg);
    add(gable, {{130, 22}, {180, 22}}, false, CreaseUse::valley, deg);
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
