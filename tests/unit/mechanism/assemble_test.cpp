// Guarantees of assembling: the plates of a piece share its paper out, each fold is a line where it is still
// there, and decoration lies on the plates it was drawn on.
#include <gtest/gtest.h>

#include <cmath>

#include "base/geometry/regions.h"
#include "mechanism/builder.h"
#include "support/designs.h"
#include "support/prints.h"
#include "support/sanitized.h"

namespace popup::test {
namespace {

TEST(Assemble, PlatesOfThePageShareItsPaperOutWithoutOverlap) {
    for (std::uint64_t seed = 1; seed <= test::sanitized_count<std::uint64_t>(40); ++seed) {
        SCOPED_TRACE(seed);
        const Built built = build(generate(seed + 500, 16));
        ASSERT_TRUE(built.assembly);
        double sum = 0.0;
        std::vector<Polygon> all;
        for (const int number : built.assembly->pieces[0].plates) {
            const Polygon& outline = built.assembly->plates[static_cast<std::size_t>(number)].outline;
            EXPECT_GT(signed_area(outline.outer), 0.0);
            sum += area(outline);
            all.push_back(outline);
        }
        EXPECT_NEAR(sum, 279.4 * 215.9, 1e-6);
        // Their union, by a polygon library, is the page: with the areas' sum this leaves no room for an
        // overlap.
        double together = 0.0;
        for (const Polygon& part : unite(all)) together += area(part);
        EXPECT_NEAR(together, 279.4 * 215.9, 0.01);
    }
}

TEST(Assemble, FoldsAreLinesExceptWhereTheyAreCutAway) {
    Design design = card(200, 200);
    add(design, "step", {{-40, -30}, {-40, 30}, {20, -30}, {20, 30}});
    const Built built = build(design);
    double gutter = 0.0;
    double mountain = 0.0;
    for (const Line& line : built.assembly->lines) {
        if (line.kind == LineKind::valley && line.at.a.x == 0.0 && line.at.b.x == 0.0)
            gutter += distance(line.at.a, line.at.b);
        if (line.kind == LineKind::mountain) {
            mountain += distance(line.at.a, line.at.b);
            EXPECT_NEAR(line.at.a.x, -20.0, 1e-12) << "q to the right of the left fold";
        }
    }
    EXPECT_NEAR(gutter, 140.0, 1e-9);
    EXPECT_NEAR(mountain, 60.0, 1e-9);
}

TEST(Assemble, DrawnLinesAreCutToTheirPlates) {
    Design design = card(200, 200);
    add(design, "step", {{-40, -30}, {-40, 30}, {40, -30}, {40, 30}});
    DrawnLine line;
    line.points.resize(2);
    line.points[0].at = {-150, 0};  // begins beside the page
    line.points[1].at = {60, 0};
    line.thickness_pt = 72;
    design.lines.push_back(line);
    const Built built = build(design);
    const auto on = [&](const std::string& name) {
        double size = 0.0;
        for (const Plate& plate : built.assembly->plates) {
            if (plate.name != name) continue;
            for (const Stroke& stroke : test::prints_of<Stroke>(plate.prints)) {
                EXPECT_NEAR(stroke.width_mm, 25.4, 1e-12);
                for (std::size_t i = 1; i < stroke.points.size(); ++i)
                    size += distance(stroke.points[i - 1], stroke.points[i]);
            }
        }
        return size;
    };
    EXPECT_NEAR(on("page/left"), 60, 1e-9);
    EXPECT_NEAR(on("e1/left"), 40, 1e-9);
    EXPECT_NEAR(on("e1/right"), 40, 1e-9);
    EXPECT_NEAR(on("page/right"), 20, 1e-9);
}

// A tower of tents, each on the centre fold of the one below.
TEST(Assemble, TowersAsDeepAsTheDocumentIsLong) {
    const int depth = sanitized_count(2000, 4);
    Design design = card();
    for (int i = 0; i < depth; ++i) {
        add(design, "tent",
            {{-5, -15}, {-5, 15}, {5, -15}, {5, 15}, {-15, -15}, {-15, 15}, {15, -15}, {15, 15}}, {0, -15},
            {0, 15}, i);
    }
    const Built built = build(design);
    ASSERT_TRUE(built.assembly);
    EXPECT_FALSE(built.diagnostics.has_findings());
    Diagnostics diagnostics;
    const auto motion = simulate(*built.assembly, {}, diagnostics);
    ASSERT_TRUE(motion) << findings(diagnostics);
    EXPECT_LE(motion->max_closure_mm, 1e-9);
    // So high a tower is not examined to the end, which is said.
    EXPECT_LT(motion->examination.value().decided_up_to_deg, 180.0);
    EXPECT_NE(findings(diagnostics).find("remark undecided: so many plates"), std::string::npos)
        << findings(diagnostics);
}

}  // namespace
}  // namespace popup::test
