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
#include "support/folded_ends.h"

namespace popup {
namespace {

using test::add_line;
using test::ends_of;
using test::told;

// A base of 100 × 60 mm with walls of 30 mm, in a sheet without cuts.
CreasePattern web_tray(std::optional<double> diagonals = {}) {
    CreasePattern tray;
    add_line(tray, {{20, 20}, {180, 20}, {180, 140}, {20, 140}}, true, CreaseUse::cut);
    add_line(tray, {{20, 50}, {180, 50}}, false, CreaseUse::mountain);
    add_line(tray, {{20, 110}, {180, 110}}, false, CreaseUse::mountain);
    add_line(tray, {{50, 20}, {50, 140}}, false, CreaseUse::mountain);
    add_line(tray, {{150, 20}, {150, 140}}, false, CreaseUse::mountain);
    add_line(tray, {{50, 50}, {20, 20}}, false, CreaseUse::valley, diagonals);
    add_line(tray, {{150, 50}, {180, 20}}, false, CreaseUse::valley, diagonals);
    add_line(tray, {{50, 110}, {20, 140}}, false, CreaseUse::valley, diagonals);
    add_line(tray, {{150, 110}, {180, 140}}, false, CreaseUse::valley, diagonals);
    return tray;
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
