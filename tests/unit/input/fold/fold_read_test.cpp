// FOLD files as others write them: units, frames, what is left out, and what is wrong.
#include <gtest/gtest.h>

#include <string>

#include "input/fold/read.h"
#include "support/designs.h"

namespace popup {
namespace {

struct Read {
    std::optional<CreasePattern> pattern;
    std::string told;
    int line = 0;  // of the first finding
};

Read read(const std::string& text, const ReadOptions& options = {}) {
    Diagnostics diagnostics("sheet.fold");
    Read result;
    result.pattern = fold::read(Source{"sheet.fold", text}, options, diagnostics);
    result.told = test::findings(diagnostics);
    if (const auto all = diagnostics.sorted(); !all.empty()) result.line = all.front().place.line;
    return result;
}

TEST(FoldRead, TakesUnitsAndMakesOthersLargeEnough) {
    const std::string square =
        R"("vertices_coords": [[0, 0], [2, 0], [2, 1]], "edges_vertices": [[0, 1], [1, 2],
[2, 0]])";
    for (const auto& [unit, mm] :
         {std::pair{"mm", 2.0}, {"cm", 20.0}, {"m", 2000.0}, {"in", 50.8}, {"pt", 2 * 25.4 / 72}}) {
        const Read one = read("{" + square + ", \"frame_unit\": \"" + unit + "\"}");
        ASSERT_TRUE(one.pattern) << one.told;
        EXPECT_NEAR(one.pattern->lines[0].points[1].x, mm, 1e-9) << unit;
        EXPECT_EQ(one.told, "") << unit;
        EXPECT_EQ(shown_point(one.pattern->ruler, one.pattern->lines[0].points[1]),
                  std::string("(2.00, 0.00) ") + unit);
    }
    const Read without = read("{" + square + "}");
    ASSERT_TRUE(without.pattern);
    EXPECT_NEAR(without.pattern->lines[0].points[1].x, fold::kSheetMm, 1e-9);
    EXPECT_NE(without.told.find("fold-size"), std::string::npos);
}

TEST(FoldRead, TellsOfUnitsAndVersionsThatFoldHasNot) {
    const std::string triangle =
        R"("vertices_coords": [[0, 0], [2, 0], [2, 1]], "edges_vertices": [[0, 1], [1, 2], [2, 0]])";
    const Read inches = read("{" + triangle + R"(, "frame_unit": "inches"})");
    ASSERT_TRUE(inches.pattern);
    EXPECT_NE(inches.told.find(R"(its frame_unit "inches" is none that FOLD has)"), std::string::npos)
        << inches.told;
    for (const char* known : {"1", "1.1", "1.2", "\"1.1\"", "\"1.0\"", "null"}) {
        const Read one = read("{" + triangle + R"(, "frame_unit": "mm", "file_spec": )" + known + "}");
        ASSERT_TRUE(one.pattern);
        EXPECT_EQ(one.told, "") << known;
    }
    for (const char* other : {"0.9", "1.3", "2", "\"two\"", "\"\"", "true", "[1]"}) {
        const Read one =
            read("{\n\"file_spec\": " + std::string(other) + R"(, "frame_unit": "mm", )" + triangle + "}");
        ASSERT_TRUE(one.pattern);
        EXPECT_NE(one.told.find("fold-version"), std::string::npos) << other;
        EXPECT_EQ(one.line, 2) << other;
    }
}

TEST(FoldRead, KnowsLettersAndAngles) {
    const Read one =
        read(R"({"frame_unit": "mm", "vertices_coords": [[0,0],[1,0],[2,0],[3,0],[4,0],[5,0],[6,0],[7,0]],
"edges_vertices": [[0,1],[1,2],[2,3],[3,4],[4,5],[5,6],[6,7]],
"edges_assignment": ["B","C","M","V","U","F","J"], "edges_foldAngle": [0,null,-90,0,45,0,0]})");
    ASSERT_TRUE(one.pattern) << one.told;
    const std::vector<CreaseLine>& lines = one.pattern->lines;
    ASSERT_EQ(lines.size(), 7U);
    const std::vector<CreaseUse> uses{CreaseUse::cut,    CreaseUse::cut,    CreaseUse::mountain,
                                      CreaseUse::valley, CreaseUse::valley, CreaseUse::flat,
                                      CreaseUse::flat};
    for (std::size_t i = 0; i < lines.size(); ++i) {
        EXPECT_EQ(lines[i].use, uses[i]) << i;
        EXPECT_EQ(lines[i].name, std::to_string(i));
    }
    EXPECT_EQ(lines[2].fold_deg, 90.0);
    EXPECT_EQ(lines[3].fold_deg, 0.0);
    EXPECT_EQ(one.pattern->fold_deg, 180.0);
    EXPECT_EQ(lines[4].fold_deg, 45.0);
    EXPECT_EQ(lines[4].place.line, 2);
    // All flat: the angles are those of the sheet as it lies there.
    const Read flat = read(
        R"({"frame_unit": "mm", "vertices_coords": [[0,0],[1,0],[2,0]], "edges_vertices": [[0,1],[1,2]],
"edges_assignment": ["M","V"], "edges_foldAngle": [0,0]})");
    ASSERT_TRUE(flat.pattern) << flat.told;
    EXPECT_EQ(flat.pattern->lines[0].fold_deg, std::nullopt);
    EXPECT_EQ(flat.pattern->lines[1].fold_deg, std::nullopt);
}

TEST(FoldRead, TakesSmallLetters) {
    const Read one = read(
        R"({"frame_unit": "mm", "vertices_coords": [[0,0],[1,0],[2,0],[3,0],[4,0],[5,0],[6,0],[7,0]],
"edges_vertices": [[0,1],[1,2],[2,3],[3,4],[4,5],[5,6],[6,7]],
"edges_assignment": ["b","c","m","v","u","f","j"]})");
    ASSERT_TRUE(one.pattern) << one.told;
    EXPECT_EQ(one.told, "");
    const std::vector<CreaseUse> uses{CreaseUse::cut,    CreaseUse::cut,  CreaseUse::mountain,
                                      CreaseUse::valley, CreaseUse::fold, CreaseUse::flat,
                                      CreaseUse::flat};
    ASSERT_EQ(one.pattern->lines.size(), uses.size());
    for (std::size_t i = 0; i < uses.size(); ++i) EXPECT_EQ(one.pattern->lines[i].use, uses[i]) << i;
    EXPECT_FALSE(read(R"({"vertices_coords": [[0,0],[1,0]], "edges_vertices": [[0,1]],
"edges_assignment": ["x"]})")
                     .pattern);
}

// Origami Simulator's y goes up, and its flat sheets have it the same everywhere; seen from above z comes
// down.
TEST(FoldRead, TakesSheetsThatLieInTheGround) {
    const std::string edges = R"("edges_vertices": [[0,1],[1,2],[2,0]], "frame_unit": "mm")";
    const Read one = read(R"({"vertices_coords": [[0,5,0],[4,5,0],[4,5,3]], )" + edges + "}");
    ASSERT_TRUE(one.pattern) << one.told;
    EXPECT_EQ(one.told, "");
    const std::vector<Vec2>& side = one.pattern->lines[1].points;
    EXPECT_EQ(side[0].x, 4.0);
    EXPECT_EQ(side[0].y, 0.0);
    EXPECT_EQ(side[1].x, 4.0);
    EXPECT_EQ(side[1].y, -3.0);
    // As ever where z is the same, though y is, too.
    const Read line = read(R"({"vertices_coords": [[0,1,2],[4,1,2],[9,1,2]], )" + edges + "}");
    ASSERT_TRUE(line.pattern) << line.told;
    EXPECT_EQ(line.pattern->lines[0].points[1].y, 1.0);
    const Read folded = read(R"({"vertices_coords": [[0,0,0],[4,1,0],[4,5,3]], )" + edges + "}");
    EXPECT_FALSE(folded.pattern);
    EXPECT_NE(folded.told.find("fold-no-pattern"), std::string::npos) << folded.told;
}

TEST(FoldRead, InheritsFrames) {
    const std::string text = R"({"vertices_coords": [[0,0],[9,0],[9,9],[0,9]], "frame_unit": "mm",
"edges_vertices": [[0,1],[1,2],[2,3],[3,0],[0,2]], "edges_assignment": ["B","B","B","B","M"], "file_frames": [
{"frame_parent": 0, "frame_inherit": true, "edges_assignment": ["B","B","B","B","V"]},
{"frame_parent": 1, "frame_inherit": true, "vertices_coords": [[0,0],[8,0],[8,8],[0,8]]},
{"frame_parent": 3, "frame_inherit": true}]})";
    EXPECT_EQ(read(text).pattern->lines[4].use, CreaseUse::mountain);
    ReadOptions options;
    options.frame = 2;
    const Read second = read(text, options);
    ASSERT_TRUE(second.pattern) << second.told;
    EXPECT_EQ(second.pattern->lines[4].use, CreaseUse::valley);
    EXPECT_EQ(second.pattern->lines[4].points[1], (Vec2{8, 8}));
    options.frame = 3;  // its own parent
    EXPECT_FALSE(read(text, options).pattern);
    options.frame = 4;
    EXPECT_NE(read(text, options).told.find("there is no frame 4"), std::string::npos);
}

TEST(FoldRead, FindsEdgesOfFaces) {
    const Read one = read(R"({"frame_unit": "mm", "vertices_coords": [[0,0],[5,0],[9,0],[9,9],[5,9],[0,9]],
"faces_vertices": [[0,1,4,5],[1,2,3,4]]})");
    ASSERT_TRUE(one.pattern) << one.told;
    EXPECT_EQ(one.pattern->lines.size(), 7U);
    int folds = 0;
    for (const CreaseLine& line : one.pattern->lines) folds += line.use == CreaseUse::fold ? 1 : 0;
    EXPECT_EQ(folds, 1);
}

TEST(FoldRead, RecognisesItsText) {
    EXPECT_TRUE(fold::recognises("\n {\"file_spec\": 1.1,"));
    EXPECT_TRUE(fold::recognises("{ \"vertices_coords\": ["));
    EXPECT_FALSE(fold::recognises("{\"settings\": {}, \"faces\": []}"));
    EXPECT_FALSE(fold::recognises("<svg/>"));
}

}  // namespace
}  // namespace popup
