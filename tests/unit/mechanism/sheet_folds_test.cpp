// Guarantees of the folds of what is cut from one sheet along curves.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "popup/motion.h"
#include "support/designs.h"
#include "support/freeform_sheet.h"
#include "support/random.h"

namespace popup::test {
namespace {

// A smooth closed curve round the middle of the page, wavy or not.
std::string random_outline(std::uint64_t seed) {
    Random random(seed);
    const Vec2 half{25.0 + 30.0 * random.unit(), 20.0 + 40.0 * random.unit()};
    const double waves = 1.2 * random.unit();
    std::vector<Vec2> at(4 + random.below(16));
    for (std::size_t i = 0; i < at.size(); ++i) {
        const double turn = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(at.size());
        const double grown = 1.0 + waves * (random.unit() - 0.5);
        at[i] = {grown * half.x * std::cos(turn), grown * half.y * std::sin(turn)};
    }
    return smooth_path(at);
}

// The corner of a plate that is nearest to a point of its page.
Vec2 corner_near(const Plate& plate, Vec2 p) {
    return *std::min_element(plate.outline.outer.begin(), plate.outline.outer.end(),
                             [p](Vec2 a, Vec2 b) { return distance(a, p) < distance(b, p); });
}

// Both plates have a corner where a fold between them begins and ends, on the curve that both were cut from,
// and these corners are one point at every opening.
TEST(SheetFolds, PlatesShareTheEndsOfTheirFoldsWhereCurvesCrossThem) {
    std::size_t folds = 0;
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        const FromXml made = from_xml(fmt::format(
            "<structure type='freeform' id='f'><outline d='{}'/></structure>", random_outline(seed)));
        if (!made.assembly) continue;
        std::vector<Frame> frames(made.assembly->plates.size());
        for (const double deg : {0.0, 90.0, 180.0}) {
            ASSERT_TRUE(place(*made.assembly, Angle::degrees(deg), frames));
            for (const Hinge& hinge : made.assembly->hinges) {
                ++folds;
                const auto a = static_cast<std::size_t>(hinge.a);
                const auto b = static_cast<std::size_t>(hinge.b);
                const Vec3 first = frames[a].point(corner_near(made.assembly->plates[a], hinge.a_line.a));
                const Vec3 last = frames[a].point(corner_near(made.assembly->plates[a], hinge.a_line.b));
                const Vec3 also_first =
                    frames[b].point(corner_near(made.assembly->plates[b], hinge.b_line.a));
                const Vec3 also_last = frames[b].point(corner_near(made.assembly->plates[b], hinge.b_line.b));
                EXPECT_LT(length(first - also_first), 1e-5) << "seed " << seed << " at " << deg;
                EXPECT_LT(length(last - also_last), 1e-5) << "seed " << seed << " at " << deg;
                EXPECT_LT(length(first - frames[a].point(hinge.a_line.a)), 1e-5) << "seed " << seed;
                EXPECT_LT(length(last - frames[a].point(hinge.a_line.b)), 1e-5) << "seed " << seed;
            }
        }
    }
    EXPECT_GT(folds, 300U);
}

// A short edge that leaves a side fold is a cut where it was drawn, however near to the fold it ends.
TEST(SheetFolds, KeepShortEdgesBesideThemWhereTheyAre) {
    for (const std::string folds : {"", "<folds top='30' bottom='20'/>"}) {
        const FromXml made = from_xml(
            "<structure type='polygon' id='f'>"
            "<outline d='M -30 -10 L 19.9876 -8.1035 L 20 -8 L 20 8 L -30 10 Z'/>" +
            folds + "</structure>");
        ASSERT_TRUE(made.assembly) << made.text;
        bool fold = false;
        bool cut = false;
        for (const Line& line : made.assembly->lines) {
            const Vec2 a = line.at.a.y < line.at.b.y ? line.at.a : line.at.b;
            const Vec2 b = line.at.a.y < line.at.b.y ? line.at.b : line.at.a;
            if (line.kind == LineKind::valley)
                fold = fold || (distance(a, Vec2{20.0, -8.0}) < 1e-6 && distance(b, Vec2{20.0, 8.0}) < 1e-6);
            if (line.kind == LineKind::cut)
                cut = cut ||
                      (distance(a, Vec2{19.9876, -8.1035}) < 1e-6 && distance(b, Vec2{20.0, -8.0}) < 1e-6);
        }
        EXPECT_TRUE(fold) << folds;
        EXPECT_TRUE(cut) << folds;
    }
    // Ends of a side fold that rounding moved still lie on it.
    const FromXml made = from_xml(
        "<structure type='polygon' id='f'><outline d='M -30 -10 L 19.99 -8 L 20 8 L -30 10 Z'/></structure>");
    ASSERT_TRUE(made.assembly) << made.text;
    EXPECT_TRUE(std::any_of(made.assembly->lines.begin(), made.assembly->lines.end(), [](const Line& line) {
        return line.kind == LineKind::valley && std::abs(line.at.a.x - 19.995) < 1e-6 &&
               std::abs(std::abs(line.at.a.y - line.at.b.y) - 16.0) < 1e-6;
    }));
}

}  // namespace
}  // namespace popup::test
