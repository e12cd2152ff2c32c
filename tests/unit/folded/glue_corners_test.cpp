// Corners of flaps that are glued to the panel beside the flap: the crease before them lies flat in the end.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "base/nth.h"
#include "popup/crease_pattern.h"
#include "popup/motion.h"
#include "support/designs.h"
#include "support/folded_ends.h"

namespace popup {
namespace {

using test::add_line;

constexpr double kHigh = 120.0;

// Four walls and a glue flap; the bottom is below them. Flaps of the second and the fourth wall have an
// oblique crease from their first corner, that has this angle, if any.
CreasePattern crash_lock(std::optional<double> deg) {
    CreasePattern pattern;
    const std::vector<double> walls{100, 60, 100, 60};
    constexpr double kDeep = 30.0;
    add_line(pattern, {{0, 0}, {-14, 4}, {-14, kHigh - 4}, {0, kHigh}}, false, CreaseUse::cut);
    double x = 0.0;
    for (std::size_t i = 0; i < walls.size(); ++i) {
        const double end = x + walls[i];
        add_line(pattern, {{x, 0}, {x, kHigh}}, false, CreaseUse::valley);
        add_line(pattern, {{x, 0}, {end, 0}}, false, CreaseUse::valley);
        add_line(pattern, {{x, kHigh}, {end, kHigh}}, false, CreaseUse::cut);
        if (i % 2 == 0) {
            add_line(pattern,
                     {{x, 0},
                      {x + 1, -kDeep - 12},
                      {x + 45, -kDeep - 12},
                      {x + 50, -kDeep},
                      {end - 28, -kDeep},
                      {end - 1, -8},
                      {end, 0}},
                     false, CreaseUse::cut);
        } else {
            add_line(
                pattern,
                {{x, 0}, {x + 0.5, -kDeep}, {x + kDeep, -kDeep}, {end - 4, -kDeep}, {end - 2, -2}, {end, 0}},
                false, CreaseUse::cut);
            add_line(pattern, {{x, 0}, {x + kDeep, -kDeep}}, false, CreaseUse::valley);
            pattern.lines.back().fold_deg = deg;
        }
        x = end;
    }
    add_line(pattern, {{x, 0}, {x, kHigh}}, false, CreaseUse::cut);
    return pattern;
}

// Degrees between the fronts of two panels in the end.
double between(const Assembly& in, const std::string& one, const std::string& other) {
    std::vector<Frame> frames(in.plates.size());
    EXPECT_TRUE(place(in, Angle::degrees(0.0), frames));
    const auto normal = [&](const std::string& name) {
        const auto at = std::find_if(in.plates.begin(), in.plates.end(),
                                     [&](const Plate& plate) { return plate.name == "sheet/" + name; });
        EXPECT_NE(at, in.plates.end()) << name;
        return at == in.plates.end() ? Vec3{}
                                     : frames[static_cast<std::size_t>(at - in.plates.begin())].normal();
    };
    return std::acos(std::clamp(dot(normal(one), normal(other)), -1.0, 1.0)) * 180.0 / 3.14159265358979;
}

TEST(GlueCorners, OfACrashLockBottomLieFlat) {
    Diagnostics diagnostics;
    const auto box = fold_sheet(crash_lock(std::nullopt), {}, diagnostics);
    ASSERT_TRUE(box);
    EXPECT_NE(test::findings(diagnostics).find("2 oblique creases lead across flaps"), std::string::npos)
        << test::findings(diagnostics);
    for (const std::string side : {"left", "right"}) {
        EXPECT_NEAR(between(*box, "bottom-glue-corner-" + side, "bottom-flap-" + side), 0.0, 1e-6);
        EXPECT_NEAR(between(*box, "bottom-flap-" + side, side), 90.0, 1e-6);
    }
    // They are scored and lie flat, and so they are told.
    EXPECT_EQ(std::count_if(box->lines.begin(), box->lines.end(),
                            [](const Line& line) { return line.fold_angle == 0.0; }),
              2);
}

TEST(GlueCorners, GoAsFarAsTheDrawingSays) {
    Diagnostics diagnostics;
    const auto box = fold_sheet(crash_lock(60.0), {}, diagnostics);
    ASSERT_TRUE(box);
    EXPECT_EQ(test::findings(diagnostics).find("glue-corners"), std::string::npos);
    double most = 0.0;
    for (const Line& line : box->lines) {
        const Vec2 way = unit(line.at.b - line.at.a);
        if (std::abs(std::abs(way.x) - std::abs(way.y)) < 0.01)
            most = std::max(most, line.fold_angle.value_or(0.0));
    }
    EXPECT_NEAR(most * 180.0 / 3.14159265358979, 60.0, 1e-6);
}

// A crease across a lid that ends elsewhere, or beyond which more hangs, is folded as any other.
TEST(GlueCorners, AreOfFlapsAtACorner) {
    CreasePattern tray;
    add_line(tray, {{0, 0}, {100, 0}, {100, 60}, {0, 60}}, true, CreaseUse::cut);
    add_line(tray, {{50, 0}, {50, 60}}, false, CreaseUse::valley);
    add_line(tray, {{50, 0}, {80, 60}}, false, CreaseUse::valley);
    Diagnostics diagnostics;
    ASSERT_TRUE(fold_sheet(tray, {}, diagnostics));
    EXPECT_EQ(test::findings(diagnostics).find("oblique"), std::string::npos) << test::findings(diagnostics);
}

}  // namespace
}  // namespace popup
