// Guarantees of drawn lines that cross: what is made of a glued piece hangs together, and holes that overlap
// are cut once; thin paper is told with its place and width.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <string_view>
#include <vector>

#include "base/geometry/regions.h"
#include "mechanism/thin_places.h"
#include "support/designs.h"

namespace popup::test {
namespace {

constexpr std::string_view kLayer =
    "<structure type='layer' id='t'><outerpoints><point x='-20' y='-20'/><point x='-20' y='20'/>"
    "<point x='20' y='-20'/><point x='20' y='20'/><point x='-20' y='-20'/><point x='-20' y='20'/>"
    "<point x='20' y='-20'/><point x='20' y='20'/></outerpoints><parentfold on='gutter'/>";

FromXml layer(std::string_view outline, std::string_view hole = "") {
    return from_xml(fmt::format("{}{}{}</structure>", kLayer,
                                outline.empty() ? "" : fmt::format("<outline d='{}'/>", outline),
                                hole.empty() ? "" : fmt::format("<hole d='{}'/>", hole)));
}

double paper_of_layer(const FromXml& made) {
    double sum = 0.0;
    if (!made.assembly) return sum;
    for (const Plate& plate : made.assembly->plates) {
        if (plate.name.starts_with("t/")) sum += area(plate.outline);
    }
    return sum;
}

TEST(DrawnLines, TheLargerLoopIsKept) {
    struct Drawn {
        std::string_view outline;
        double left;
    };
    for (const auto& [outline, left] : std::vector<Drawn>{
             // A fish tail above a square; its lines cross at (12, 26).
             {"M -20 -20 H 20 V 20 L 8 20 L 16 32 L 8 32 L 16 20 H -20 Z", 1600.0},
             // A loop to the inside, wound twice: even-odd would cut it out but for one point.
             {"M -20 -20 H 20 V 20 H 10 V 10 H 16 V 15 H 5 V 20 H -20 Z", 1600.0 - 5.0 * 5.0}}) {
        SCOPED_TRACE(outline);
        const FromXml made = layer(outline);
        ASSERT_TRUE(made.assembly) << made.text;
        EXPECT_NE(
            made.text.find("warning outline-crosses: \"t\": its outline crosses or touches itself at ("),
            std::string::npos)
            << made.text;
        EXPECT_NEAR(paper_of_layer(made), left, 25.0);
        for (const Plate& plate : made.assembly->plates) EXPECT_FALSE(touching({plate.outline}));
    }
}

TEST(DrawnLines, WhatIsDrawnRightStaysWithoutAWord) {
    for (const std::string_view outline :
         {"M -20 -20 H 20 V 20 H -20 Z",
          // A keyhole: its two sides lie on one another, and the even-odd rule makes a hole of it.
          "M -20 -20 H 20 V 20 H 10 V 10 H 15 V 5 H 5 V 10 H 10 V 20 H -20 Z",
          // A line out and back.
          "M -20 -20 H 20 V 20 H 10 V 30 V 20 H -20 Z"})
        EXPECT_EQ(layer(outline).text, "") << outline;
    for (const std::string_view hole :
         {"M 4 -8 h 4 v 4 h -4 z M 12 -8 h 4 v 4 h -4 z", "M 4 0 a 3 3 0 0 0 6 0 z"})
        EXPECT_EQ(layer("", hole).text, "") << hole;
}

TEST(DrawnLines, HolesThatOverlapAreCutAsOne) {
    const double whole = paper_of_layer(layer(""));
    struct Holes {
        std::string_view d;
        double lost;
    };
    for (const auto& [d, lost] : std::vector<Holes>{
             {"M 4 -8 h 8 v 8 h -8 z M 8 -4 h 8 v 8 h -8 z", 112.0},
             {"M 8 -4 h 8 v 8 h -8 z M 4 -8 v 8 h 8 v -8 z", 112.0},  // round the other way
             {"M 4 0 h 5 v 5 h -5 z M 4 0 h 5 v 5 h -5 z M 12 0 h 2 v 2 h -2 z", 29.0},  // one of them twice
             {"M 2 -8 h 4 v 4 h -4 z M 5 -8 h 4 v 4 h -4 z M 8 -8 h 4 v 4 h -4 z", 40.0}}) {
        SCOPED_TRACE(d);
        const FromXml made = layer("", d);
        ASSERT_TRUE(made.assembly) << made.text;
        EXPECT_TRUE(made.text.starts_with("warning holes-cross: \"t\": ")) << made.text;
        EXPECT_NEAR(whole - paper_of_layer(made), lost, 1e-3);
    }
    EXPECT_EQ(layer("", "M 4 -8 h 8 v 8 h -8 z M 8 -4 h 8 v 8 h -8 z").text,
              "warning holes-cross: \"t\": 2 of its holes overlap, at (10.00, -2.00) mm by 16.00 mm², which "
              "would fall out; they are cut as one [2 lines of holes -> 1 of them]\n");
}

TEST(DrawnLines, MergedHolesKeepTheirCurves) {
    const FromXml made = layer("", "M 4 0 a 4 4 0 1 0 8 0 a 4 4 0 1 0 -8 0 z M 9 0 h 8 v 2 h -8 z");
    ASSERT_TRUE(made.assembly) << made.text;
    EXPECT_GE(made.assembly->curves.size(), 10U);
    // A circle of 4 mm and what reaches out of it.
    const double lost = paper_of_layer(layer("")) - paper_of_layer(made);
    EXPECT_GT(lost, 3.14 * 16.0 + 10.0);
    EXPECT_LT(lost, 3.15 * 16.0 + 11.0);
}

TEST(DrawnLines, RingsOfHolesLeaveAnIslandThatIsTold) {
    const FromXml made = layer("",
                               "M 2 -8 h 16 v 3 h -16 z M 2 5 h 16 v 3 h -16 z M 2 -8 h 3 v 16 h -3 z "
                               "M 15 -9 h 3 v 18 h -3 z");
    EXPECT_FALSE(made.assembly);
    EXPECT_NE(made.text.find("has an island, which would fall out"), std::string::npos) << made.text;
}

TEST(DrawnLines, ThinPlacesHaveTheirWidth) {
    const auto piece = [](Ring outer, std::vector<Ring> holes = {}) {
        return Polygon{std::move(outer), std::move(holes)};
    };
    // Two squares of 10 mm and a strip of 0.4 mm between them.
    const auto neck = thinnest(piece({{0, 0},
                                      {10, 0},
                                      {10, 4},
                                      {15, 4},
                                      {15, 0},
                                      {25, 0},
                                      {25, 10},
                                      {15, 10},
                                      {15, 4.4},
                                      {10, 4.4},
                                      {10, 10},
                                      {0, 10}}),
                               kTearsMm);
    ASSERT_TRUE(neck);
    EXPECT_NEAR(neck->width_mm, 0.4, 1e-9);
    EXPECT_FALSE(neck->at_hole);
    EXPECT_NEAR(neck->at.y, 4.2, 1e-9);
    // The same with a gap of 0.4 mm in place of the strip, and the tip of a wedge.
    EXPECT_FALSE(thinnest(piece({{0, 0}, {10, 0}, {10, 4}, {2, 4}, {2, 4.4}, {10, 4.4}, {10, 10}, {0, 10}}),
                          kTearsMm));
    EXPECT_FALSE(thinnest(piece({{0, 0}, {30, 0}, {60, 4.9}, {60, 5.1}, {30, 10}, {0, 10}}), kTearsMm));
    // Beside a hole; and a tongue that reaches into a hole.
    const auto beside = thinnest(
        piece({{0, 0}, {30, 0}, {30, 30}, {0, 30}}, {{{5, 0.3}, {5, 5}, {9, 5}, {9, 0.3}}}), kTearsMm);
    ASSERT_TRUE(beside);
    EXPECT_NEAR(beside->width_mm, 0.3, 1e-9);
    EXPECT_TRUE(beside->at_hole);
    const auto tongue = thinnest(piece({{-5, -5}, {30, -5}, {30, 30}, {-5, 30}}, {{{0, 0},
                                                                                   {0, 20},
                                                                                   {9.8, 20},
                                                                                   {9.8, 15},
                                                                                   {5, 15},
                                                                                   {5, 10},
                                                                                   {15, 10},
                                                                                   {15, 15},
                                                                                   {10.2, 15},
                                                                                   {10.2, 20},
                                                                                   {20, 20},
                                                                                   {20, 0}}}),
                                 kTearsMm);
    ASSERT_TRUE(tongue);
    EXPECT_NEAR(tongue->width_mm, 0.4, 1e-9);
}

TEST(DrawnLines, ThinPaperIsToldAndCutAsDrawn) {
    const FromXml neck = layer("M -20 -20 H 20 V 20 H 10.1 V 25 H 16 V 31 H 4 V 25 H 9.9 V 20 H -20 Z");
    EXPECT_TRUE(
        neck.text.starts_with("warning paper-too-thin: \"t\": its parts hang together by a neck of 0.20 "
                              "mm at (10.00, 2"))
        << neck.text;
    EXPECT_NEAR(paper_of_layer(neck), 1600.0 + 0.2 * 5.0 + 12.0 * 6.0, 1e-6);
    const FromXml beside = layer("", "M 4 19.75 h 4 v -4 h -4 z");
    EXPECT_TRUE(
        beside.text.starts_with("warning paper-too-thin: \"t\": only 0.25 mm of paper is left beside a "
                                "hole at ("))
        << beside.text;
    EXPECT_NEAR(paper_of_layer(beside), 1600.0 - 16.0, 1e-6);
}

// An end of a seam that the outline goes through draws no other point to it.
TEST(DrawnLines, OnlyEndsThatAreMissedAreSnappedTo) {
    const FromXml met = layer("M -20 -20 H 20 V 20 L 19.8 20.4 L 10 20.4 L 10 30 H -20 Z");
    EXPECT_EQ(met.text, "");
    EXPECT_NEAR(paper_of_layer(met), 1600.0 + 30.0 * 10.0 + 0.5 * 0.4 * (9.8 + 10.0), 1e-6);
    EXPECT_NE(layer("M -20 -20 H 20 V 19.7 L 10 20.4 L 10 30 H -20 Z").text.find("outline-snapped"),
              std::string::npos);
}

}  // namespace
}  // namespace popup::test
