// Gears of the kit: they mesh, and are what they say they are.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "support/flatlang_runs.h"
#include "support/run_program.h"

namespace popup::flatlang {
namespace {

namespace fs = std::filesystem;

constexpr double kPi = std::numbers::pi;

// Two gears, each about its own middle, turned as mesh() turns them.
struct Pair {
    Points a, b;
    Vec2 apart;  // of b's middle from a's
};

struct GearSpec {
    int teeth;
    std::string settings;  // ".member = value" of it
};

std::string gear_text(const std::string& variable, const GearSpec& spec) {
    std::string text = variable + " = gear(" + std::to_string(spec.teeth) + ")\n";
    if (!spec.settings.empty()) text += variable + spec.settings + "\n";
    return text;
}

Pair meshed(const GearSpec& first, const GearSpec& second, const std::string& both = "",
            double direction = 25) {
    std::string text =
        "load(\"kit/gear.fl\") load(\"kit/assembly.fl\")\n" + gear_text("a", first) + gear_text("b", second);
    if (!both.empty()) text += "a" + both + " b" + both + "\n";
    text += "m = mesh(a, b)\nm.direction = " + std::to_string(direction) + "\n";
    const ProgramRun run = ran(text);
    EXPECT_EQ(run.trail.polygons.size(), 4U);
    if (run.trail.polygons.size() != 4) return {};
    Pair pair;
    pair.apart = middle_of_bore(run.trail.polygons[3]);
    pair.a = flat(run.trail.polygons[0]);
    pair.b = moved(flat(run.trail.polygons[2]), 0, {-pair.apart.x, -pair.apart.y});
    return pair;
}

struct Overlaps {
    double least = 1e9;
    double most = 0.0;
};

// While the first turns by a tooth, with the second turned by `behind` besides.
Overlaps overlaps(const Pair& pair, int teeth_a, int teeth_b, double behind) {
    Overlaps result;
    constexpr int kSteps = 16;
    for (int i = 0; i < kSteps; ++i) {
        const double turn = 2 * kPi / teeth_a * i / kSteps;
        const double area = overlap(moved(pair.a, turn, {0, 0}),
                                    moved(pair.b, -turn * teeth_a / teeth_b + behind, pair.apart));
        result.least = std::min(result.least, area);
        result.most = std::max(result.most, area);
    }
    return result;
}
double worst_overlap(const Pair& pair, int teeth_a, int teeth_b, double behind) {
    return overlaps(pair, teeth_a, teeth_b, behind).most;
}

// Chords that lie off the true flanks by the tolerance may meet along a tooth's height (0.25 inches here).
constexpr double kTolerance = 0.0005;
constexpr double kTouch = 2 * kTolerance * 0.25;

TEST(FlatlangKitGear, MeshedGearsTurnWithoutOverlapAndHaveTheBacklashTheySay) {
    const std::vector<std::pair<int, int>> pairs{{24, 24}, {12, 12}, {12, 60}, {17, 25},
                                                 {31, 13}, {10, 20}, {9, 9}};
    for (const auto& [a, b] : pairs) {
        SCOPED_TRACE(std::to_string(a) + " and " + std::to_string(b) + " teeth");
        const double backlash = 0.02;
        const Pair pair = meshed({a, ""}, {b, ""}, ".backlash = 0.02");
        EXPECT_NEAR(std::hypot(pair.apart.x, pair.apart.y), (a + b) / 8.0 / 2, 1e-5);
        const double radius = b / 8.0 / 2;
        EXPECT_LT(worst_overlap(pair, a, b, 0), 1e-9);
        // Half of the backlash lies on each side, within what chords lie off the flanks.
        for (const int side : {-1, 1}) {
            EXPECT_LT(worst_overlap(pair, a, b, side * (backlash / 2 - 2 * kTolerance) / radius), 1e-9);
            // At every moment: they turn evenly.
            EXPECT_GT(overlaps(pair, a, b, side * (backlash / 2 + 3 * kTolerance) / radius).least, 1e-7);
        }
    }
}

TEST(FlatlangKitGear, GearsOfFewTeethAndOtherAnglesRunTooWithoutBacklash) {
    for (const char* angle : {"14.5", "20", "30"}) {
        for (const auto& [a, b] : std::vector<std::pair<int, int>>{{6, 6}, {6, 50}, {8, 13}, {40, 40}}) {
            SCOPED_TRACE(std::string(angle) + " degrees, " + std::to_string(a) + " and " + std::to_string(b));
            const Pair pair =
                meshed({a, ".backlash = 0"}, {b, ".backlash = 0"}, ".pressure_angle = " + std::string(angle));
            EXPECT_LT(worst_overlap(pair, a, b, 0), kTouch);
        }
    }
}

TEST(FlatlangKitGear, TrapezoidTeethLieWithinInvoluteOnesAndMeshWithBoth) {
    for (const int teeth : {8, 17, 40}) {
        SCOPED_TRACE(teeth);
        const Pair pair = meshed({teeth, ""}, {teeth, ".profile = \"trapezoid\""}, "", 0);
        const double half_pitch = teeth % 2 == 0 ? kPi / teeth : 0.0;
        EXPECT_LT(area_of(ClipperLib::ctDifference, moved(pair.b, -half_pitch, {0, 0}), pair.a),
                  teeth * 4e-5);
        EXPECT_LT(worst_overlap(pair, teeth, teeth, 0), 1e-9);
        const Pair both =
            meshed({teeth, ".profile = \"trapezoid\""}, {2 * teeth + 1, ".profile = \"trapezoid\""});
        EXPECT_LT(worst_overlap(both, teeth, 2 * teeth + 1, 0), 1e-9);
    }
}

// A rack with straight flanks and sharp corners rolls on the pitch circle: it never cuts into the gear, and
// touches each of its corners at some moment, but for those on the tips.
TEST(FlatlangKitGear, IsWhatARackCuts) {
    const double pitch = 2.0;
    for (const int teeth : {6, 9, 16, 23, 60}) {
        for (const double degrees : {14.5, 20.0, 30.0}) {
            SCOPED_TRACE(std::to_string(teeth) + " teeth, " + std::to_string(degrees) + " degrees");
            const ProgramRun run =
                ran("load(\"kit/gear.fl\") g = gear(" + std::to_string(teeth) +
                    ", 2) g.pressure_angle = " + std::to_string(degrees) + " g.backlash = 0.04 g.draw()");
            const double radius = teeth / pitch / 2;
            const double outer = radius + 1 / pitch;
            const double lowest = radius - 1.25 / pitch;
            const double slope = std::tan(degrees * kPi / 180);
            const double half = kPi / (4 * pitch) + 0.04 / 4;
            std::size_t touched = 0;
            for (const Vec2& p : flat(run.trail.polygons.front())) {
                const double r = std::hypot(p.x, p.y);
                // From the middle of the space left of the first tooth, which lies along +y.
                double angle = std::atan2(-p.x, p.y) - kPi / teeth;
                if (std::abs(angle) > kPi / teeth) continue;  // all spaces are alike
                double deepest = -1.0;
                for (int i = -4000; i <= 4000; ++i) {
                    const double roll = i * 0.0004 * (12.0 / teeth);
                    const double x = r * std::cos(angle + roll);
                    const double y = std::abs(r * std::sin(angle + roll) - radius * roll);
                    deepest = std::max(deepest, std::min(x - lowest, (half + (x - radius) * slope - y) *
                                                                         std::cos(degrees * kPi / 180)));
                }
                EXPECT_LT(deepest, 1e-5) << r << " " << angle;
                if (r < outer - 1e-4) {
                    EXPECT_GT(deepest, -4e-4) << r << " " << angle;
                    ++touched;
                } else {
                    EXPECT_NEAR(r, outer, 1e-5);
                }
            }
            EXPECT_GT(touched, 10U);
        }
    }
}

TEST(FlatlangKitGear, FlanksAreSampledToTheirTolerance) {
    const auto outline = [](const std::string& tolerance) {
        return flat(ran("load(\"kit/gear.fl\") g = gear(20, 4) g.tolerance = " + tolerance + " g.draw()")
                        .trail.polygons.front());
    };
    const Points fine = outline("0.0001");
    for (const double tolerance : {0.004, 0.001}) {
        const Points coarse = outline(std::to_string(tolerance));
        EXPECT_LT(coarse.size(), fine.size());
        for (std::size_t i = 0; i < fine.size(); ++i) {
            double nearest = 1.0;
            for (std::size_t j = 0; j < coarse.size(); ++j) {
                const Vec2 a = coarse[j];
                const Vec2 b = coarse[(j + 1) % coarse.size()];
                const double length = std::hypot(b.x - a.x, b.y - a.y);
                const double along =
                    std::clamp(((fine[i].x - a.x) * (b.x - a.x) + (fine[i].y - a.y) * (b.y - a.y)) / length,
                               0.0, length);
                nearest = std::min(nearest, std::hypot(a.x + (b.x - a.x) * along / length - fine[i].x,
                                                       a.y + (b.y - a.y) * along / length - fine[i].y));
            }
            EXPECT_LT(nearest, tolerance + 0.00011);
        }
    }
}

// The turtle takes places for the same that are 0.0001 inches apart on either axis.
TEST(FlatlangKitGear, PointsAreNeverTooNearForAnOutline) {
    for (const char* settings : {"300, 4", "1000, 4", "1000, 64", "6, 0.2", "25, 64", "60, 30"}) {
        SCOPED_TRACE(settings);
        const ProgramRun run = ran("load(\"kit/gear.fl\") g = gear(" + std::string(settings) +
                                   ") g.tolerance = 0.0001 g.backlash = 0 g.draw()");
        ASSERT_EQ(run.trail.polygons.size(), 2U);
        EXPECT_GT(run.trail.polygons.front().points.size(), 100U);
        EXPECT_EQ(run.trail.polygons.front().points.size() + 4, run.trail.segments.size());
    }
}

TEST(FlatlangKitGear, AFamilyIsMadeByDefinitions) {
    const std::string sample = test::read_file(fs::path(POPUP_SOURCE_DIR) / "samples/flatlang/gear.fl");
    for (const int teeth : {11, 24, 37}) {
        ReadOptions options;
        options.program.definitions = {{"teeth", std::to_string(teeth)}};
        const ProgramRun run = ran(sample, options);
        const Points outline = flat(run.trail.polygons.front());
        int rising = 0;
        const auto outside = [&](std::size_t i) {
            const Vec2& p = outline[i % outline.size()];
            return std::hypot(p.x, p.y) > teeth / 16.0;
        };
        for (std::size_t i = 0; i < outline.size(); ++i) rising += !outside(i) && outside(i + 1) ? 1 : 0;
        EXPECT_EQ(rising, teeth);
    }
}

}  // namespace
}  // namespace popup::flatlang
