// Trays with webs in their corners, and folds that end at other angles than they are to.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "popup/crease_pattern.h"
#include "support/designs.h"

namespace popup {
namespace {

void add(CreasePattern& pattern, std::vector<Vec2> points, bool closed, CreaseUse use,
         std::optional<double> deg = {}) {
    CreaseLine line;
    line.points = std::move(points);
    line.closed = closed;
    line.use = use;
    line.fold_deg = deg;
    pattern.lines.push_back(std::move(line));
}

// A base of 100 × 60 mm with walls of 30 mm, in a sheet without cuts.
CreasePattern web_tray(std::optional<double> diagonals = {}) {
    CreasePattern tray;
    add(tray, {{20, 20}, {180, 20}, {180, 140}, {20, 140}}, true, CreaseUse::cut);
    add(tray, {{20, 50}, {180, 50}}, false, CreaseUse::mountain);
    add(tray, {{20, 110}, {180, 110}}, false, CreaseUse::mountain);
    add(tray, {{50, 20}, {50, 140}}, false, CreaseUse::mountain);
    add(tray, {{150, 20}, {150, 140}}, false, CreaseUse::mountain);
    add(tray, {{50, 50}, {20, 20}}, false, CreaseUse::valley, diagonals);
    add(tray, {{150, 50}, {180, 20}}, false, CreaseUse::valley, diagonals);
    add(tray, {{50, 110}, {20, 140}}, false, CreaseUse::valley, diagonals);
    add(tray, {{150, 110}, {180, 140}}, false, CreaseUse::valley, diagonals);
    return tray;
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

TEST(WebCorners, AreFoldedFlatBetweenWallsThatStandUpright) {
    for (const std::optional<double> diagonals : {std::optional<double>(), std::optional(180.0)}) {
        Diagnostics diagnostics("tray");
        const auto tray = fold_sheet(web_tray(diagonals), {}, diagnostics);
        ASSERT_TRUE(tray);
        EXPECT_EQ(ends_of(*tray), (std::map<double, int>{{-135.0, 8}, {-90.0, 4}, {180.0, 4}}));
        EXPECT_FALSE(diagnostics.has_findings()) << test::findings(diagnostics);
        const auto webs = told(diagnostics, "web-corners");
        ASSERT_EQ(webs.size(), 1U);
        EXPECT_EQ(webs[0].message,
                  "4 corners of this sheet are closed by webs, the first at (50.00, 50.00) mm: their "
                  "diagonals are folded flat, and the folds beside them by 135.0°, so that walls at right "
                  "angles meet");
        std::vector<std::string> names;
        for (const Plate& plate : tray->plates) names.push_back(plate.name);
        for (const char* name : {"sheet/base", "sheet/front", "sheet/right", "sheet/back", "sheet/left"})
            EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
    }
}

// Whoever says other angles gets those, or hears of it.
TEST(WebCorners, AreLeftToTheirDrawing) {
    Diagnostics diagnostics("tray");
    const auto tray = fold_sheet(web_tray(120.0), {}, diagnostics);
    ASSERT_TRUE(tray);
    EXPECT_TRUE(told(diagnostics, "web-corners").empty());
    const auto other = told(diagnostics, "other-angle");
    ASSERT_EQ(other.size(), 1U) << test::findings(diagnostics);
    // The worst of them is named with both its angles, and all that are off are counted.
    int off = 0;
    double most = 0.0;
    for (const auto& [deg, count] : ends_of(*tray)) {
        const double by = std::abs(std::abs(deg) - (deg > 0.0 ? 120.0 : 90.0));
        if (by > 1.0) off += count;
        most = std::max(most, by);
    }
    EXPECT_GT(most, 5.0);
    EXPECT_TRUE(other[0].message.starts_with(
        std::to_string(off) + " folds end at other angles than they are to, for the loops there close so: "))
        << other[0].message;
}

}  // namespace
}  // namespace popup
