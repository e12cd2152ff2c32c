// Guarantees of what stands upright on a fold: where boxes and floating layers are at every angle, worked out
// here from their measures alone, and how they are cut.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "base/geometry/regions.h"
#include "popup/motion.h"
#include "popup/pattern.h"
#include "support/designs.h"

namespace popup::test {
namespace {

constexpr double kP = 20.0;       // of the walls from the gutter
constexpr double kHeight = 30.0;  // of the walls
constexpr double kLo = -10.0;     // along the gutter
constexpr double kHi = 50.0;

Design with_walls(const std::string& type, double right, const std::string& ends = "") {
    Design design = card();
    design.version = "3.0";
    Structure& made = add(design, type, {{-kP, kLo}, {-kP, kHi}, {right, kLo}, {right, kHi}});
    const ElementInfo& info = *find_element(type);
    made.argument(*find_parameter(info, "height")).value = kHeight;
    if (!ends.empty()) made.argument(*find_parameter(info, "ends")).value = ends;
    return design;
}

struct Posed {
    std::map<std::string, Frame> frames;
    std::map<std::string, Polygon> outlines;

    // Whether some corner of the plate is at that point of the world.
    [[nodiscard]] bool has_corner(const std::string& plate, Vec3 at) const {
        const Ring& ring = outlines.at(plate).outer;
        return std::any_of(ring.begin(), ring.end(),
                           [&](Vec2 p) { return distance(frames.at(plate).point(p), at) < 1e-6; });
    }
};

Posed posed(const Assembly& assembly, double deg) {
    std::vector<Frame> frames(assembly.plates.size());
    EXPECT_TRUE(place(assembly, Angle::degrees(deg), frames)) << deg;
    Posed result;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        result.frames[assembly.plates[i].name] = frames[i];
        result.outlines[assembly.plates[i].name] = assembly.plates[i].outline;
    }
    return result;
}

// Sine and cosine of half the opening.
std::pair<double, double> half_opening(int deg) {
    const double half = 0.5 * deg * std::numbers::pi / 180.0;
    return {std::sin(half), std::cos(half)};
}

// The world has the gutter along y at x = z = 0, and the card opens to both sides of the plane x = 0. What is
// p away from it is at x = ±p sin(θ/2), z = p cos(θ/2) below the front; the front looks to +z where the card
// lies open. Upright is square to the gutter, in the plane x = 0.
TEST(Box, StandsInTheMiddlePlaneAtEveryAngle) {
    for (const std::string ends : {"in", "out"}) {
        SCOPED_TRACE(ends);
        const Built built = build(with_walls("box", kP, ends));
        ASSERT_TRUE(built.assembly);
        EXPECT_EQ(findings(built.diagnostics), "");
        const double way = ends == "in" ? 1.0 : -1.0;
        for (int deg = 0; deg <= 180; deg += 3) {
            const auto [s, c] = half_opening(deg);
            const Posed now = posed(*built.assembly, deg);
            for (const double z : {kP * c, kP * c + kHeight}) {
                for (const double y : {kLo, kHi}) {
                    EXPECT_TRUE(now.has_corner("e1/left", {-kP * s, y, z})) << deg;
                    EXPECT_TRUE(now.has_corner("e1/right", {kP * s, y, z})) << deg;
                }
                const double front = kLo + way * kP * c;
                const double back = kHi - way * kP * c;
                for (const std::string plate : {"e1/front-left", "e1/front-right"})
                    EXPECT_TRUE(now.has_corner(plate, {0.0, front, z})) << deg << " " << plate;
                for (const std::string plate : {"e1/back-left", "e1/back-right"})
                    EXPECT_TRUE(now.has_corner(plate, {0.0, back, z})) << deg << " " << plate;
            }
        }
    }
}

TEST(Box, LooksOutwards) {
    const Built built = build(with_walls("box", kP));
    ASSERT_TRUE(built.assembly);
    const Posed open = posed(*built.assembly, 170.0);
    EXPECT_LT(open.frames.at("e1/left").normal().x, -0.99);
    EXPECT_GT(open.frames.at("e1/right").normal().x, 0.99);
    EXPECT_LT(open.frames.at("e1/front-left").normal().y, -0.9);
    EXPECT_GT(open.frames.at("e1/back-right").normal().y, 0.9);
}

TEST(Box, IsOneStripWithThreeTabs) {
    const Built built = build(with_walls("box", kP));
    ASSERT_TRUE(built.assembly);
    Diagnostics diagnostics;
    const auto pattern = make_pattern(*built.assembly, {}, diagnostics);
    ASSERT_TRUE(pattern);
    EXPECT_EQ(findings(diagnostics), "");
    ASSERT_EQ(pattern->pieces.size(), 2U);
    const PatternPiece& strip = pattern->pieces[1];
    ASSERT_EQ(strip.silhouette.size(), 1U);
    double wide = 0.0;
    for (const Plate& plate : built.assembly->plates) {
        if (plate.name.starts_with("e1/")) wide += area(plate.outline) / kHeight;
    }
    EXPECT_NEAR(wide, 2.0 * (kHi - kLo) + 4.0 * kP, 1e-9);
    std::size_t tabs = 0;
    for (const auto& label : strip.labels) tabs += label.kind == LabelKind::tab ? 1U : 0U;
    EXPECT_EQ(tabs, 3U);
    // The tab that closes it lies behind the first wall.
    ASSERT_EQ(strip.targets.size(), 1U);
    EXPECT_TRUE(strip.targets[0].on_back);
    EXPECT_EQ(pattern->pieces[0].targets.size(), 2U);
}

TEST(FloatingLayer, HasItsTopParallelToThePlanesUnderIt) {
    constexpr double kQ = 26.0;
    const Built built = build(with_walls("floating-layer", kQ));
    ASSERT_TRUE(built.assembly);
    EXPECT_EQ(findings(built.diagnostics), "");
    for (int deg = 0; deg <= 180; deg += 3) {
        const auto [s, c] = half_opening(deg);
        const Posed now = posed(*built.assembly, deg);
        for (const double y : {kLo, kHi}) {
            EXPECT_TRUE(now.has_corner("e1/left", {-kP * s, y, kP * c})) << deg;
            EXPECT_TRUE(now.has_corner("e1/right", {kQ * s, y, kQ * c})) << deg;
            for (const std::string plate : {"e1/left", "e1/top-left"})
                EXPECT_TRUE(now.has_corner(plate, {-kP * s, y, kP * c + kHeight})) << deg << " " << plate;
            for (const std::string plate : {"e1/top-left", "e1/top-right", "e1/pillar"})
                EXPECT_TRUE(now.has_corner(plate, {0.0, y, kHeight})) << deg << " " << plate;
            for (const std::string plate : {"e1/right", "e1/top-right"})
                EXPECT_TRUE(now.has_corner(plate, {kQ * s, y, kQ * c + kHeight})) << deg << " " << plate;
            EXPECT_TRUE(now.has_corner("e1/pillar", {0.0, y, 0.0})) << deg;
        }
        EXPECT_LT(distance(now.frames.at("e1/top-left").normal(), now.frames.at("page/left").normal()), 1e-9);
    }
}

// Its walls and its pillar may lean together: one way, by hand. A box holds itself, and what stands on a
// floating layer does not hold it.
TEST(FloatingLayer, LeansOneWay) {
    const Built built = build(with_walls("floating-layer", kP));
    ASSERT_TRUE(built.assembly);
    const auto free = free_plates(*built.assembly);
    ASSERT_EQ(free.size(), 1U);
    EXPECT_EQ(free[0].ways, 1);
    EXPECT_EQ(free[0].plates.size(), 5U);
    EXPECT_TRUE(free[0].parallel);
    EXPECT_TRUE(free_plates(*build(with_walls("box", kP)).assembly).empty());
}

TEST(FloatingLayer, IsAStripAndAPillar) {
    const Built built = build(with_walls("floating-layer", kP));
    ASSERT_TRUE(built.assembly);
    Diagnostics diagnostics;
    const auto pattern = make_pattern(*built.assembly, {}, diagnostics);
    ASSERT_TRUE(pattern);
    EXPECT_EQ(findings(diagnostics), "");
    ASSERT_EQ(pattern->pieces.size(), 3U);
    EXPECT_EQ(pattern->pieces[2].name, "e1/pillar");
    // Both walls and the pillar's foot on the page; its head is glued from below.
    EXPECT_EQ(pattern->pieces[0].targets.size(), 3U);
    ASSERT_EQ(pattern->pieces[1].targets.size(), 1U);
    EXPECT_TRUE(pattern->pieces[1].targets[0].on_back);
}

}  // namespace
}  // namespace popup::test
