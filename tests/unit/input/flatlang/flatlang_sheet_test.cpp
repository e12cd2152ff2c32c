// Programs that draw a sheet of cuts and folds: what they draw, and what they are told.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "popup/language.h"
#include "support/designs.h"

namespace popup {
namespace {

Reading read_sheet(const std::string& program, Diagnostics& diagnostics, bool as_2008 = false) {
    ReadOptions options;
    options.program.as_2008 = as_2008;
    return read_source_text({"sheet.fl", program}, options, diagnostics);
}

CreasePattern sheet_of(const std::string& program) {
    Diagnostics diagnostics("sheet.fl");
    Reading reading = read_sheet(program, diagnostics);
    EXPECT_EQ(test::findings(diagnostics), "");
    EXPECT_TRUE(reading.creases);
    return reading.creases ? std::move(*reading.creases) : CreasePattern{};
}

std::string told_of(const std::string& program) {
    Diagnostics diagnostics("sheet.fl");
    const Reading reading = read_sheet(program, diagnostics);
    EXPECT_FALSE(reading.creases) << program;
    EXPECT_FALSE(reading.assembly) << program;
    return test::findings(diagnostics);
}

TEST(FlatLangSheet, HasLinesOfFourKinds) {
    const CreasePattern sheet = sheet_of(
        "sheet(\"mm\")\n"
        "cutline([0, 0], [[90, 0], [90, 40]], [0, 40], [0, 0])\n"
        "cutline([10, 10], [20, 10])\n"
        "mountain([30, 0], [30, 40])\n"
        "valley([60, 0], [60, 40], 120)\n"
        "crease([75, 0], [75, 40], 0)\n");
    EXPECT_EQ(sheet.file, "sheet.fl");
    EXPECT_EQ(sheet.stem, "sheet");
    ASSERT_EQ(sheet.lines.size(), 5u);
    EXPECT_EQ(sheet.lines[0].use, CreaseUse::cut);
    EXPECT_TRUE(sheet.lines[0].closed);
    EXPECT_EQ(sheet.lines[0].points, (std::vector<Vec2>{{0, 0}, {90, 0}, {90, 40}, {0, 40}}));
    EXPECT_FALSE(sheet.lines[1].closed);
    EXPECT_EQ(sheet.lines[2].use, CreaseUse::mountain);
    EXPECT_FALSE(sheet.lines[2].fold_deg);
    EXPECT_EQ(sheet.lines[3].use, CreaseUse::valley);
    EXPECT_EQ(sheet.lines[3].fold_deg, 120.0);
    EXPECT_EQ(sheet.lines[4].use, CreaseUse::fold);
    EXPECT_EQ(sheet.lines[4].fold_deg, 0.0);
    EXPECT_EQ(sheet.lines[4].place.line, 6);
    EXPECT_EQ(shown_point(sheet.ruler, {30, 40}), "(30.00, 40.00) mm");
}

TEST(FlatLangSheet, IsInInchesUnlessItSaysOtherwise) {
    const CreasePattern sheet = sheet_of("sheet()\ncutline([0, 0], [2, 0], [2, 1], [0, 0])\n");
    ASSERT_EQ(sheet.lines.size(), 1u);
    EXPECT_EQ(sheet.lines[0].points[1], (Vec2{50.8, 0.0}));
    EXPECT_EQ(shown_point(sheet.ruler, {50.8, 25.4}), "(2.00, 1.00) in");
}

TEST(FlatLangSheet, TellsWhatIsWrong) {
    EXPECT_EQ(told_of("cutline([0, 0], [1, 0])"),
              "error flatlang-runtime: cutline() has no sheet to draw on\n");
    EXPECT_EQ(told_of("sheet()\nsheet()"), "error flatlang-runtime: sheet() was called before, on line 1\n");
    EXPECT_EQ(told_of("sheet(\"cm\")"),
              "error flatlang-runtime: argument 1 of sheet() is \"cm\", which is no unit of its points\n");
    EXPECT_EQ(told_of("sheet(5)"),
              "error flatlang-runtime: argument 1 of sheet() is a number, which is no unit of its points\n");
    EXPECT_EQ(told_of("sheet()\nvalley([0, 0], 90)"),
              "error flatlang-runtime: valley() is given 1 point, and a line has two at least\n");
    EXPECT_EQ(
        told_of("sheet()\nvalley([0, 0], [1, 0], 270)"),
        "error flatlang-runtime: argument 3 of valley() is 270, where an angle from 0 to 180 degrees is "
        "expected\n");
    EXPECT_EQ(told_of("sheet()\ncutline([0, 0], [1, 0], 90)"),
              "error flatlang-runtime: argument 3 of cutline() has a number\n");
    EXPECT_EQ(told_of("sheet()\ncutline([0, 0], [1, 0, 5])"),
              "error flatlang-runtime: argument 2 of cutline() has a point of 3 numbers\n");
    EXPECT_EQ(told_of("sheet()\ncutline([0, 0], [1, \"a\"])"),
              "error flatlang-runtime: argument 2 of cutline() has a text in a point\n");
    EXPECT_EQ(told_of("sheet()\npitch(90) forward(1)\ncutline([0, 0], pos())"),
              "error flatlang-runtime: argument 2 of cutline() has a point 1 above the sheet\n");
    EXPECT_EQ(told_of("sheet()\ncutline([0, 0], [1000000, 0])"),
              "error flatlang-runtime: argument 2 of cutline() has a point too far off\n");
}

TEST(FlatLangSheet, IsAllThatAProgramMakes) {
    EXPECT_EQ(told_of("sheet()\ncutline([0, 0], [1, 0], [1, 1], [0, 0])\nforward(1)"),
              "error flatlang-card-and-parts: the program makes a sheet here, and its turtle draws 1 line "
              "besides\n");
    EXPECT_EQ(
        told_of("popup()\nsheet()"),
        "error flatlang-card-and-parts: the program makes a sheet of cuts and folds here, and a card on "
        "line 1\n");
}

TEST(FlatLangSheet, IsNotThereInEdition2008) {
    Diagnostics diagnostics("sheet.fl");
    const Reading reading =
        read_sheet("sheet(\"mm\")\ncutline([0, 0], [1, 0], [1, 1], [0, 0])\nforward(1)", diagnostics, true);
    EXPECT_FALSE(reading.creases);
}

}  // namespace
}  // namespace popup
