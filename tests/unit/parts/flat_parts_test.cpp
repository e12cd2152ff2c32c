// Flat parts as an assembly: what nothing moves goes the way of all that does.
#include "parts/flat_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "popup/pattern.h"
#include "support/prints.h"
#include "support/sheet_example.h"

namespace popup {
namespace {

using test::rectangle;

FlatPart square(const std::string& name, double left) {
    FlatPart part;
    part.name = name;
    part.paper = {{rectangle(left, 0, left + 40, 40), {}}};
    return part;
}

Pattern pattern_of(const Assembly& assembly) {
    Diagnostics diagnostics;
    auto pattern = make_pattern(assembly, {}, diagnostics);
    EXPECT_TRUE(pattern);
    EXPECT_TRUE(diagnostics.sorted().empty());
    return pattern.value_or(Pattern{});
}

TEST(FlatParts, ArePiecesWhosePlatesNothingMoves) {
    FlatPart loose = square("frame", 0);
    loose.paper.push_back({rectangle(100, 0, 110, 10), {}});
    const Assembly assembly = assembly_of({{square("lid", 50), loose}, {}});
    EXPECT_FALSE(moves(assembly));
    EXPECT_FALSE(has_model(assembly));  // it is not known where they stand
    ASSERT_EQ(assembly.pieces.size(), 2U);
    EXPECT_EQ(assembly.pieces[0].plates, (std::vector<int>{0}));
    EXPECT_EQ(assembly.pieces[1].plates, (std::vector<int>{1, 2}));
    ASSERT_EQ(assembly.plates.size(), 3U);
    EXPECT_EQ(assembly.plates[0].name, "lid");
    EXPECT_EQ(assembly.plates[1].name, "frame/1");
    EXPECT_EQ(assembly.plates[2].name, "frame/2");
    EXPECT_EQ(assembly.plates[2].piece, 1);
    const Pattern pattern = pattern_of(assembly);
    ASSERT_EQ(pattern.pieces.size(), 2U);
    EXPECT_EQ(pattern.pieces[1].name, "frame");
    EXPECT_EQ(pattern.pieces[1].cuts.size(), 2U);
    EXPECT_EQ(pattern.pieces[1].silhouette.size(), 2U);
}

TEST(FlatParts, WithFacesStandWhereTheseDo) {
    FlatPart part = square("box", 0);
    Frame upright;
    upright.axes = {Vec3{1, 0, 0}, Vec3{0, 0, 1}, Vec3{0, -1, 0}};
    part.faces = {{{rectangle(0, 0, 40, 20), {}}, Frame{}}, {{rectangle(0, 20, 40, 40), {}}, upright}};
    part.traces = {{Vec3{0, 0, 0}, Vec3{1, 0, 0}}};
    FlatParts parts{{part}, {{"trail", -1, {{Vec3{5, 0, 0}, Vec3{6, 0, 0}}}}}};
    const Assembly assembly = assembly_of(std::move(parts));
    EXPECT_TRUE(has_model(assembly));
    ASSERT_EQ(assembly.plates.size(), 2U);
    ASSERT_TRUE(assembly.plates[1].stands);
    EXPECT_EQ(assembly.plates[1].stands->normal(), (Vec3{0, -1, 0}));
    ASSERT_EQ(assembly.traces.size(), 2U);
    EXPECT_EQ(assembly.traces[0].piece, 0);
    EXPECT_EQ(assembly.traces[0].name, "box");
    EXPECT_EQ(assembly.traces[1].piece, -1);
    // Its paper is cut as it is, not as the faces lie.
    EXPECT_EQ(pattern_of(assembly).pieces.at(0).silhouette.size(), 1U);
}

// Folds in line are one where they fold by the same angle; seams of parts are the folds of their tabs.
TEST(FlatParts, FoldsKeepTheirAngles) {
    FlatPart part = square("strip", 0);
    part.lines = {{LineKind::valley, {{0, 10}, {20, 10}}, 1.0},
                  {LineKind::valley, {{20, 10}, {30, 10}}, 1.0},
                  {LineKind::valley, {{30, 10}, {40, 10}}, 2.0},
                  {LineKind::seam, {{0, 30}, {40, 30}}},
                  {LineKind::mark, {{1, 1}, {2, 2}, {3, 1}}}};
    const PatternPiece piece = pattern_of(assembly_of({{part}, {}})).pieces.at(0);
    ASSERT_EQ(piece.lines.size(), 5U);
    EXPECT_EQ(piece.lines[0].fold_angle, 1.0);
    EXPECT_NEAR(distance(piece.lines[0].at.a, piece.lines[0].at.b), 30.0, 1e-9);
    EXPECT_EQ(piece.lines[1].fold_angle, 2.0);
    EXPECT_EQ(piece.lines[2].kind, LineKind::seam);
    EXPECT_FALSE(piece.lines[2].glued_on);
    EXPECT_FALSE(piece.lines[2].fold_angle);
    EXPECT_EQ(piece.lines[4].kind, LineKind::mark);
}

// Areas, then strokes, then texts, as they are painted; with texts of its own a part has no other name on it.
TEST(FlatParts, AreLabelledUnlessTheyHaveTexts) {
    FlatPart part = square("plate", 0);
    EXPECT_EQ(pattern_of(assembly_of({{part}, {}})).pieces.at(0).labels.at(0).text, "plate");
    part.texts = {{"hello", {20, 20}, 3.0, 0.0}};
    part.strokes = {{{{1, 1}, {2, 2}}, 0.5, {}}};
    part.fills = {{{rectangle(1, 1, 5, 5), {}}, {1, 2, 3}}};
    const PatternPiece piece = pattern_of(assembly_of({{part}, {}})).pieces.at(0);
    EXPECT_TRUE(piece.labels.empty());
    ASSERT_EQ(piece.prints.size(), 3U);
    EXPECT_TRUE(std::holds_alternative<Area>(piece.prints[0].print));
    EXPECT_TRUE(std::holds_alternative<Stroke>(piece.prints[1].print));
    EXPECT_TRUE(std::holds_alternative<Text>(piece.prints[2].print));
}

}  // namespace
}  // namespace popup
