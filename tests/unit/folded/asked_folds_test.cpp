// Folds that are asked for get their angle where others, of which nothing is said, can follow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "popup/crease_pattern.h"

namespace popup {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

// Four creases at one corner, sectors of 50°, 70°, 130° and 110° between them: it folds flat (50° + 130° =
// 180°). One is a mountain of the given angle; the others are folds.
CreasePattern corner(double asked_deg) {
    const auto end = [](double deg) { return 60.0 * Vec2{std::cos(deg * kDegree), std::sin(deg * kDegree)}; };
    CreasePattern pattern;
    pattern.lines.push_back({{end(0), end(110), end(240), end(310)}, true, CreaseUse::cut});
    pattern.lines.push_back({{{0, 0}, end(0)}, false, CreaseUse::mountain, asked_deg});
    for (const double deg : {110.0, 240.0, 310.0})
        pattern.lines.push_back({{{0, 0}, end(deg)}, false, CreaseUse::fold});
    return pattern;
}

// Of a corner that folds flat opposite folds are folded alike, and the tangents of half their angles go in
// proportion (Tachi, "Generalization of rigid-foldable quadrilateral-mesh origami", 2009).
TEST(AskedFolds, OthersFollowThem) {
    const double ratio = std::cos(60.0 * kDegree) / std::cos(10.0 * kDegree);
    for (const double asked : {10.0, 30.0, 60.0, 90.0, 120.0, 150.0, 170.0}) {
        Diagnostics diagnostics("corner");
        const auto assembly = fold_sheet(corner(asked), {}, diagnostics);
        ASSERT_TRUE(assembly.has_value()) << asked;
        EXPECT_TRUE(diagnostics.sorted().empty()) << asked << ": " << diagnostics.sorted().front().message;
        std::vector<double> angles;
        for (const Line& line : assembly->lines) {
            if (line.fold_angle) angles.push_back(*line.fold_angle / kDegree);
        }
        std::sort(angles.begin(), angles.end());
        const double other = 2.0 * std::atan(ratio * std::tan(0.5 * asked * kDegree)) / kDegree;
        ASSERT_EQ(angles.size(), 4U) << asked;
        EXPECT_NEAR(angles[0], other, 1e-5) << asked;
        EXPECT_NEAR(angles[1], other, 1e-5) << asked;
        EXPECT_NEAR(angles[2], asked, 1e-5) << asked;
        EXPECT_NEAR(angles[3], asked, 1e-5) << asked;
    }
}

}  // namespace
}  // namespace popup
