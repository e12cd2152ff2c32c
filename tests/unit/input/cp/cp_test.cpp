// .cp files: what is read of them, and what is told of those that are damaged.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "popup/crease_pattern.h"
#include "popup/language.h"
#include "support/designs.h"

namespace popup {
namespace {

struct ReadCp {
    Reading reading;
    std::string told;
};

ReadCp read(const std::string& text, const std::string& name = "bird.cp") {
    Diagnostics diagnostics(name);
    ReadCp result;
    result.reading = read_source_text({name, text}, {}, diagnostics);
    result.told = test::findings(diagnostics);
    return result;
}

// A square of 400 about its middle, as ORIPA draws it.
const std::string kBorder =
    "1 -200 -200 200 -200\n1 200 -200 200 200\n1 200 200 -200 200\n1 -200 200 -200 -200\n";

TEST(Cp, LinesAreWhatTheirKindsSay) {
    const ReadCp one =
        read(kBorder + "2 -200 0.0 0 0\n3 0 0 200 1e2\r\n4 0 0 0 -200\n\n# a note\n0 0 0 10 10\n");
    ASSERT_TRUE(one.reading.creases) << one.told;
    const CreasePattern& pattern = *one.reading.creases;
    ASSERT_EQ(pattern.lines.size(), 8U);
    EXPECT_EQ(pattern.stem, "bird");
    EXPECT_EQ(pattern.fold_deg, 180.0);
    const std::vector<CreaseUse> uses{CreaseUse::cut,  CreaseUse::cut,      CreaseUse::cut,
                                      CreaseUse::cut,  CreaseUse::mountain, CreaseUse::valley,
                                      CreaseUse::flat, CreaseUse::flat};
    for (std::size_t i = 0; i < uses.size(); ++i) {
        EXPECT_EQ(pattern.lines[i].use, uses[i]) << i;
        EXPECT_FALSE(pattern.lines[i].closed);
    }
    // 200 mm, and y goes down the page.
    EXPECT_EQ(pattern.lines[5].points, (std::vector<Vec2>{{0, 0}, {100, -50}}));
    EXPECT_EQ(pattern.lines[5].place.line, 6);
    EXPECT_EQ(shown_point(pattern.ruler, {100, -50}), "(200.00, 100.00)");
    EXPECT_EQ(one.told,
              "remark cp-size: the pattern has no unit: its longer side of 400 was made 200 mm long\n");
}

// Twice: a blintz corner, whose two valleys go up as they are seen.
TEST(Cp, BecomesAModelThatFolds) {
    const ReadCp one = read(kBorder + "3 -200 0 0 -200\n3 0 200 200 0\n");
    ASSERT_TRUE(one.reading.creases);
    Diagnostics diagnostics("bird.cp");
    const auto assembly = fold_sheet(*one.reading.creases, {}, diagnostics);
    ASSERT_TRUE(assembly) << test::findings(diagnostics);
    EXPECT_EQ(assembly->plates.size(), 3U);
    EXPECT_EQ(assembly->joints.size(), 3U);
    int valleys = 0;
    for (const Line& line : assembly->lines) valleys += line.kind == LineKind::valley ? 1 : 0;
    EXPECT_EQ(valleys, 2);
}

// A fold from left to right above the middle of the drawing is above the middle of the sheet.
TEST(Cp, IsNotMirrored) {
    const ReadCp one = read(kBorder + "2 -200 -150 200 -150\n");
    ASSERT_TRUE(one.reading.creases);
    EXPECT_GT(one.reading.creases->lines.back().points.front().y, 0.0);
    EXPECT_LT(one.reading.creases->lines.back().points.front().x, 0.0);
}

TEST(Cp, SaysWhereAFileIsDamaged) {
    EXPECT_EQ(read("1 0 0 1\n").told, "error cp-value: this line has 4 numbers, and not five\n");
    EXPECT_EQ(read("1\n").told, "error cp-value: this line has 1 number, and not five\n");
    EXPECT_EQ(read("1 0 0 1 1 1\n").told, "error cp-value: this line has more than five numbers\n");
    EXPECT_EQ(read("7 0 0 1 1\n").told, "error cp-value: there is no line of kind 7: kinds go from 0 to 4\n");
    EXPECT_EQ(read("2.5 0 0 1 1\n").told,
              "error cp-value: there is no line of kind 2.5: kinds go from 0 to 4\n");
    EXPECT_EQ(read("1 0 zero 1 1\n").told, "error cp-value: \"zero\" is not a number, or larger than 1e9\n");
    EXPECT_EQ(read("1 0 nan 1 1\n").told, "error cp-value: \"nan\" is not a number, or larger than 1e9\n");
    EXPECT_EQ(read("1 0 1e300 1 1\n").told,
              "error cp-value: \"1e300\" is not a number, or larger than 1e9\n");
    EXPECT_EQ(read("").told, "error cp-no-pattern: the file has no lines that are cut or folded\n");
    EXPECT_EQ(read("1 5 5 5 5\n").told,
              "error cp-no-pattern: the file has no lines that are cut or folded\n");
    Diagnostics diagnostics("bird.cp");
    EXPECT_FALSE(read_source_text({"bird.cp", kBorder + "  2 0 x 1 1\n"}, {}, diagnostics).creases);
    ASSERT_EQ(diagnostics.sorted().size(), 1U);
    EXPECT_EQ(diagnostics.sorted()[0].place.line, 5);
    EXPECT_EQ(diagnostics.sorted()[0].place.column, 7);
    // Not a page of the same mistake.
    std::string many;
    for (int i = 0; i < 100; ++i) many += "1 0 0\n";
    Diagnostics of_many("bird.cp");
    read_source_text({"bird.cp", many}, {}, of_many);
    EXPECT_EQ(of_many.sorted().size(), 10U);
}

TEST(Cp, IsKnownOnStandardInput) {
    const ReadCp one = read(kBorder, "-");
    EXPECT_TRUE(one.reading.creases) << one.told;
}

}  // namespace
}  // namespace popup
