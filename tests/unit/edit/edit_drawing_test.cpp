// Edits of folded sheets in space, held against cartons of the kit that were drawn as large, and against
// lengths that Pythagoras knows.
#include "popup/edit_drawing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "popup/crease_pattern.h"
#include "popup/diagnostics.h"
#include "popup/files.h"
#include "popup/geometry.h"
#include "popup/language.h"
#include "popup/refinement.h"
#include "popup/sheet_edit.h"
#include "support/run_program.h"
#include "unit/edit/drawing_edits.h"

namespace popup::test {
namespace {

const std::filesystem::path kSource = POPUP_SOURCE_DIR;
constexpr double kExactMm = 0.01;

// The corners that lines of a drawing go through, moved so that the least is at the origin.
std::vector<Vec2> corners_of(const std::string& drawing) {
    const CreasePattern pattern = pattern_of(drawing);
    Box box;
    std::vector<Vec2> found;
    for (const CreaseLine& line : pattern.lines) {
        for (const Vec2 p : line.points) box.extend(p);
        found.insert(found.end(), line.points.begin(), line.points.end());
    }
    for (Vec2& p : found) p = p - box.min;
    return found;
}

// Corners of the one that are further than that from all of the other.
std::size_t away(const std::vector<Vec2>& from, const std::vector<Vec2>& to, double mm) {
    return static_cast<std::size_t>(std::count_if(from.begin(), from.end(), [&](Vec2 p) {
        return std::none_of(to.begin(), to.end(), [&](Vec2 q) { return distance(p, q) <= mm; });
    }));
}
// The same by so many quarter turns, as a sheet may be laid on another way.
std::vector<Vec2> turned(std::vector<Vec2> points, int quarters) {
    for (; quarters > 0; --quarters) {
        Box box;
        for (Vec2& p : points) {
            p = left_of(p);
            box.extend(p);
        }
        for (Vec2& p : points) p = p - box.min;
    }
    return points;
}
void expect_same(const std::vector<Vec2>& is, const std::vector<Vec2>& wanted, const std::string& what) {
    ASSERT_FALSE(wanted.empty()) << what;
    std::size_t least = is.size() + wanted.size();
    for (int quarters = 0; quarters < 4; ++quarters) {
        const std::vector<Vec2> other = turned(wanted, quarters);
        least = std::min(least, away(is, other, kExactMm) + away(other, is, kExactMm));
    }
    EXPECT_EQ(least, 0U) << what;
}

// The sheet of a carton of the kit; of two pieces the first.
std::string carton(const std::string& call) {
    const test::ScratchDirectory there;
    test::write_file(there / "box.fl", "load(\"kit/carton.fl\")\n" + call + "\n");
    const test::RunResult run = test::popupc({"build", "box.fl", "-o", "box.svg", "--quiet"},
                                             {.directory = there.path(), .input = {}, .environment = {}});
    EXPECT_EQ(run.exit, 0) << run.err;
    return test::read_file(there / "box.svg");
}

std::string tube() { return test::read_file(kSource / "samples/folded/carton.svg"); }

TEST(EditDrawing, AnExtrudedCartonIsThatOfTheKitDrawnAsLarge) {
    struct Row {
        std::string from, edit, to;
    };
    for (const Row& row : std::vector<Row>{
             {"straight_tuck_end(80, 50, 60, 0.5)", "extrude right --by 15mm",
              "straight_tuck_end(95, 50, 60, 0.5)"},
             {"straight_tuck_end(80, 50, 60, 0.5)", "extrude top --by 1cm",
              "straight_tuck_end(80, 50, 70, 0.5)"},
             {"straight_tuck_end(80, 50, 60, 0.5)", "extrude bottom --by -10",
              "straight_tuck_end(80, 50, 50, 0.5)"},
             {"reverse_tuck_end(60, 40, 90, 0.5)", "extrude right --by 10",
              "reverse_tuck_end(70, 40, 90, 0.5)"},
             {"reverse_tuck_end(60, 40, 90, 0.5)", "extrude top --by 10",
              "reverse_tuck_end(60, 40, 100, 0.5)"},
             {"sleeve(80, 40, 60, 0.4)", "extrude right --by 10", "sleeve(90, 40, 60, 0.4)"},
             {"sleeve(80, 40, 60, 0.4)", "extrude front --by 10", "sleeve(80, 50, 60, 0.4)"},
             {"hexagonal_box(70, 50, 0.5)", "extrude top --by 10", "hexagonal_box(70, 60, 0.5)"},
             {"hexagonal_box(70, 50, 0.5)", "extrude bottom --by -8", "hexagonal_box(70, 42, 0.5)"}}) {
        const Done done = edit(carton(row.from), {row.edit});
        ASSERT_TRUE(done.text) << row.from << " " << row.edit << "\n" << done.told;
        expect_same(corners_of(*done.text), corners_of(carton(row.to)), row.from + " " + row.edit);
    }
}

// The kit makes dust flaps narrower where a wider lid lets its tuck come in by a flatter arc: their four
// outer and four inner corners are elsewhere there, by a quarter of a millimetre. All others are not.
TEST(EditDrawing, AWiderCartonIsThatOfTheKitButForItsDustFlaps) {
    const Done done = edit(carton("reverse_tuck_end(60, 80, 90, 0.5)"), {"extrude front --by 10"});
    ASSERT_TRUE(done.text) << done.told;
    const std::vector<Vec2> made = corners_of(*done.text);
    const std::vector<Vec2> wanted = corners_of(carton("reverse_tuck_end(60, 90, 90, 0.5)"));
    EXPECT_EQ(away(made, wanted, 0.3), 0U);
    EXPECT_EQ(away(wanted, made, 0.3), 0U);
    std::set<std::pair<long, long>> off;
    for (const Vec2 p : wanted) {
        if (away({p}, made, kExactMm) > 0) off.emplace(std::lround(p.x * 100), std::lround(p.y * 100));
    }
    EXPECT_EQ(off.size(), 8U);
}

TEST(EditDrawing, ALongerTrayIsThatOfTheKit) {
    const std::string base = "tray_with_lid(120, 80, 40, 20, 0.6)";
    const Done done = edit(carton(base), {"extrude front --by 10"});
    ASSERT_TRUE(done.text) << done.told;
    const Done back = edit(*done.text, {"extrude front --by -10"});
    ASSERT_TRUE(back.text) << back.told;
    expect_same(corners_of(*back.text), corners_of(carton(base)), base);
    expect_same(corners_of(*done.text), corners_of(carton("tray_with_lid(130, 80, 40, 20, 0.6)")), base);
}

// The rim of a wall of 40 mm, 10 mm further out: the wall is √(40² + 10²) mm high, and so are the edges
// beside it, which end 10 mm further along the rims of the walls there.
TEST(EditDrawing, AnEdgeThatLeansIsAsLongAsPythagorasSays) {
    const Done done = edit(kTray, {"edge front.1-2 --by 0,-10,0"});
    ASSERT_TRUE(done.text) << done.told;
    const double high = std::hypot(40.0, 10.0);
    const std::vector<Vec2> wanted{{50, 190}, {150, 190}, {150, 150},         {190, 150},
                                   {190, 40}, {150, 50},  {150, 50.0 - high}, {50, 50.0 - high},
                                   {50, 50},  {10, 40},   {10, 150},          {50, 150}};
    const CreasePattern made = pattern_of(*done.text);
    ASSERT_EQ(made.lines.front().points.size(), wanted.size());
    EXPECT_EQ(away(made.lines.front().points, wanted, 1e-5), 0U) << *done.text;
    EXPECT_EQ(away(wanted, made.lines.front().points, 1e-5), 0U) << *done.text;
    // arctan(10 / 40) beyond the upright.
    EXPECT_NE(done.told.find("between front and base by 75.96°, and not by 90.00°"), std::string::npos)
        << done.told;
}

TEST(EditDrawing, WhatDoesNotMoveStaysByteForByte) {
    const Done done = edit(kTray, {"edge front.1-2 --by 0,-10,0"});
    ASSERT_TRUE(done.text) << done.told;
    std::string wanted = kTray;
    const std::string outline = "M50 10H150V50H190V150H150V190H50V150H10V50H50Z";
    wanted.replace(wanted.find(outline), outline.size(),
                   "M 50,10 150,10 150,50 190,50 190,160 150,150 150,191.231056 50,191.231056 50,150 10,160 "
                   "10,50 50,50 Z");
    // The front leans by arctan(10 / 40), and the third side of the crease says so.
    wanted.replace(wanted.find("<path id"), 5, "<path data-fold-angle=\"90 90 75.963757 90\"");
    EXPECT_EQ(*done.text, wanted);
}

// Edits that turn folds, read again: what moves is where it was to go, all else where it was.
TEST(EditDrawing, TurnedFoldsAreReadAgain) {
    struct Row {
        std::string what, edit;
        std::set<std::string> move;
        Vec3 by;
    };
    std::string two = kTray;  // the creases as lines of their own, two in one element
    const std::string crease = "M50 50H150V150H50Z";
    two.replace(two.find(crease), crease.size(), "M50 50H150M150 150H50M50 50V150M150 150V50");
    std::string named = kTray;  // that do not say which way
    named.replace(named.find("mountain"), 8, "fold");
    std::string rectangle = kTray;
    const std::string path =
        "<path id=\"crease\" class=\"mountain\" stroke=\"#ff0000\" d=\"" + crease + "\"/>";
    rectangle.replace(rectangle.find(path), path.size(), kRectangle);
    for (const Row& row :
         std::vector<Row>{{kTray, "edge front.1-2 --by 0,-10,0", {"front.1", "front.2"}, {0, -10, 0}},
                          {two, "edge front.1-2 --by 0,-10,0", {"front.1", "front.2"}, {0, -10, 0}},
                          {two, "edge left.1-4 --by 4,0,2", {"left.1", "left.4"}, {4, 0, 2}},
                          {rectangle, "edge front.1-2 --by 0,-10,0", {"front.1", "front.2"}, {0, -10, 0}},
                          {rectangle, "edge left.1-4 --by -4,0,2", {"left.1", "left.4"}, {-4, 0, 2}},
                          {named, "edge front.1-2 --by 0,20,0", {"front.1", "front.2"}, {0, 20, 0}}}) {
        const Done done = edit(row.what, {row.edit});
        ASSERT_TRUE(done.text) << row.edit << done.told;
        EXPECT_NE(done.told.find("[folds-turn]"), std::string::npos) << done.told;
        const auto before = vertices_of(row.what);
        const auto after = vertices_of(*done.text);
        ASSERT_EQ(after.size(), before.size());
        int moved = 0;
        for (const auto& [name, at] : before) {
            ASSERT_TRUE(after.contains(name)) << name;
            const bool goes = std::any_of(row.move.begin(), row.move.end(), [&](const std::string& one) {
                return distance(before.at(one), at) < 1e-6;
            });
            EXPECT_LT(distance(after.at(name), goes ? at + row.by : at), 1e-4)
                << row.edit << ": " << name << "\n"
                << *done.text;
            moved += goes ? 1 : 0;
        }
        EXPECT_EQ(moved, 4);  // each as a corner of two walls
        // Nothing turns any more when it is edited again.
        const Done again = edit(*done.text, {"extrude base --by 0"});
        ASSERT_TRUE(again.text) << again.told;
        EXPECT_EQ(*again.text, *done.text);
        EXPECT_EQ(again.told.find("[folds-turn]"), std::string::npos) << again.told;
    }
}

// Where four scored folds meet, corners that rise leave less than 360°. The refusal stands at one of the
// folds.
TEST(EditDrawing, WhatWouldNotLieFlatIsToldWhereItIsDrawn) {
    const std::string drawing =
        R"(<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100">
 <g fill="none" stroke-width="0.3">
  <path class="cut" stroke="#000" d="M0 0H100V100H0Z"/>
  <path class="valley" stroke="#f0f" data-fold-angle="0" d="M0 0 50 50M100 0 50 50M100 100 50 50M0 100 50 50"/>
 </g>
</svg>
)";
    Diagnostics said("box.svg");
    DrawingEditOptions options;
    const std::vector<EditLine> lines{{words_of("vertex 1.2 --by 0,0,10"), {}}};
    EXPECT_FALSE(edit_drawing({"box.svg", drawing}, lines, options, said, said));
    const Diagnostic told = said.sorted().back();
    EXPECT_EQ(told.code, "edit-refused");
    EXPECT_EQ(
        told.message,
        "the panels around (100.00, 100.00) mm would not lie flat on the sheet: they miss each other by "
        "5.6 mm");
    EXPECT_EQ(told.place.line, 4);
    EXPECT_EQ(told.place.column, 3);
}

// Lines whose first and last dashes are drawn by themselves would leave these behind.
TEST(EditDrawing, LinesInPiecesAreRefusedAsWhatTheyAre) {
    const std::string crease =
        "<path id=\"crease\" class=\"mountain\" stroke=\"#ff0000\" d=\"M50 50H150V150H50Z\"/>";
    const std::string pen = "<path class=\"mountain\" stroke=\"#ff0000\" ";
    const std::string pieces = pen + "d=\"M50 150h4\"/>" + pen + "d=\"M146 150h4\"/>";
    for (const std::string line : {"M56 150H144", "M56 150H100H144"}) {
        std::string drawing = kTray;
        drawing.replace(drawing.find(crease), crease.size(),
                        pen + "d=\"M50 150V50H150V150\"/>" + pen + "stroke-dasharray=\"4 2\" d=\"" + line +
                            "\"/>" + pieces);
        const Done done = edit(drawing, {"extrude front --by 10"});
        EXPECT_FALSE(done.text) << *done.text;
        EXPECT_NE(done.told.find("the first or last dash of its line is another element [edit-refused]"),
                  std::string::npos)
            << done.told;
        // Where it does not move it is no matter.
        EXPECT_TRUE(edit(drawing, {"extrude back --by 10"}).text);
    }
}

// An envelope: all of it lies in one plane, and would move as a whole.
TEST(EditDrawing, WhatLiesFlatIsNotExtruded) {
    const std::string envelope =
        R"(<svg xmlns="http://www.w3.org/2000/svg" width="220mm" height="200mm" viewBox="0 0 220 200">
 <g fill="none" stroke-width="0.3">
  <path class="cut" stroke="#000" d="M60 60 110 15 160 60 200 95 160 130 110 175 60 130 20 95Z"/>
  <path class="valley" stroke="#00f" data-fold-angle="180" d="M60 60H160V130H60Z"/>
 </g>
</svg>
)";
    for (const std::string panel : {"1", "4"}) {
        const Done done = edit(envelope, {"extrude " + panel + " --by 10"});
        EXPECT_FALSE(done.text) << *done.text;
        EXPECT_EQ(done.told, "extrude moves all that lies in the plane of " + panel +
                                 ", and the whole folded shape does: it would be where it is, only further "
                                 "on [bad-edit]\n");
    }
    // In its plane it grows, and where its folds go by less it has room inside.
    EXPECT_TRUE(edit(envelope, {"edge 1+2 --by 0,5,0"}).text);
    std::string open = envelope;
    open.replace(open.find("180"), 3, "90");
    const Done done = edit(open, {"extrude base --by 10"});
    EXPECT_TRUE(done.text) << done.told;
}

// A base that is no rectangle any more becomes a polygon, with all else that its element said.
TEST(EditDrawing, ARectangleMayBecomeAPolygon) {
    struct Row {
        std::string rectangle, style;
        bool by_name = false;
    };
    for (const Row& row : std::vector<Row>{
             {kRectangle, ""},
             {"<rect width='100' height='100'\n  stroke='#ff0000' x='50' y='50' class='mountain' ></rect>",
              ""},
             {kRectangle, "text { direction: ltr } .rect { fill: none } .rectangle, #polygon { fill: none }"},
             {kRectangle, "g>rect{ stroke: #ff0000 }", true},
             {kRectangle, ".fold { fill: none } polygon, path { stroke: #ff0000 }", true},
             {kRectangle, "rect { stroke: #ff0000 }", true}}) {
        std::string drawing = kTray;
        const std::string crease =
            "<path id=\"crease\" class=\"mountain\" stroke=\"#ff0000\" d=\"M50 50H150V150H50Z\"/>";
        drawing.replace(drawing.find(crease), crease.size(), row.rectangle);
        if (!row.style.empty()) drawing.insert(drawing.find(" <g"), "<style>" + row.style + "</style>");
        const Done done = edit(drawing, {"vertex front+left+base --by -3,-5,0"});
        if (row.by_name) {
            EXPECT_FALSE(done.text);
            EXPECT_NE(done.told.find("this <rect> would be none any more"), std::string::npos) << done.told;
            continue;
        }
        ASSERT_TRUE(done.text) << done.told;
        EXPECT_EQ(done.text->find("<rect"), std::string::npos) << *done.text;
        const Done of_path = edit(kTray, {"vertex front+left+base --by -3,-5,0"});
        ASSERT_TRUE(of_path.text) << of_path.told;
        const auto wanted = vertices_of(*of_path.text);
        const auto made = vertices_of(*done.text);
        ASSERT_EQ(made.size(), wanted.size()) << *done.text;
        for (const auto& [name, at] : wanted) EXPECT_LT(distance(made.at(name), at), 1e-4) << name;
    }
}

TEST(EditDrawing, NothingMovedIsEveryByte) {
    for (const std::string& drawing : {tube(), kTray}) {
        const Done done = edit(drawing, {"extrude right --by 0"});
        ASSERT_TRUE(done.text) << done.told;
        EXPECT_EQ(*done.text, drawing);
    }
}

TEST(EditDrawing, ThereAndBackIsTheOldDrawing) {
    struct Row {
        std::string drawing, there, back;
    };
    for (const Row& row : std::vector<Row>{
             {tube(), "extrude right --by 10mm", "extrude right --by -10mm"},
             {tube(), "extrude top-flap-front --by 10mm", "extrude top-flap-front --by -10mm"},
             {kTray, "vertex front+left --by 0,0,-5", "vertex front+left --by 0,0,5"},
             {kTray, "extrude base --by 10", "extrude base --by -10"},
             {carton("fefco_0201(300, 200, 150, 3)"), "extrude front --by 20", "extrude front --by -20"},
             {carton("gift_bag(180, 80, 240, 0.2)"), "extrude right-1 --by 6", "extrude right-1 --by -6"}}) {
        const Done done = edit(row.drawing, {row.there, row.back});
        ASSERT_TRUE(done.text) << row.there << done.told;
        expect_same(corners_of(*done.text), corners_of(row.drawing), row.there);
    }
}

// What the program says of it: nothing crosses, and it closes.
TEST(EditDrawing, AnEditedCartonFoldsClosed) {
    const test::ScratchDirectory there;
    for (const std::string one :
         {"extrude top --by 10mm", "extrude front --by -5mm", "extrude left --by 7mm"}) {
        const Done done = edit(carton("straight_tuck_end(80, 50, 60, 0.5)"), {one});
        ASSERT_TRUE(done.text) << done.told;
        test::write_file(there / "box.svg", *done.text);
        const test::RunResult run = test::popupc({"check", "--as", "folded", "box.svg"},
                                                 {.directory = there.path(), .input = {}, .environment = {}});
        EXPECT_EQ(run.exit, 0) << one << run.err;
        EXPECT_EQ(run.err.find("warning"), std::string::npos) << one << run.err;
    }
}

// Corners and panels of a refinement are those of the new drawing, as a file of it says them.
TEST(EditDrawing, TheRefinementFollows) {
    const std::string gift = test::read_file(kSource / "tests/cases/suggest/gift.svg");
    const CreasePattern pattern = pattern_of(gift);
    Diagnostics said;
    SuggestOptions suggest;
    suggest.near_mm = 40.0;
    const auto found = suggest_joins(pattern, suggest, said);
    ASSERT_TRUE(found);
    const auto joins = accept_joins(pattern, suggest, *found, "merge 1", {}, said);
    ASSERT_TRUE(joins);
    DrawingEditOptions options;
    options.joins = *joins;
    Diagnostics of_edit("gift.svg");
    const std::vector<EditLine> edits{{{"extrude", "base", "--by", "5"}, {}}};
    const auto edited = edit_drawing({"gift.svg", gift}, edits, options, of_edit, of_edit);
    ASSERT_TRUE(edited) << (of_edit.sorted().empty() ? "" : of_edit.sorted().front().message);
    const CreasePattern after = pattern_of(edited->text);
    const auto refined = refine_shape(after, {{}, options.joins, nullptr}, said);
    ASSERT_TRUE(refined) << (said.sorted().empty() ? "" : said.sorted().back().message);
    EXPECT_TRUE(refined->closes) << refined->residual_mm;
}

TEST(EditDrawing, NamesWhatIsMeant) {
    struct Row {
        std::string one, same;
    };
    for (const Row& row : std::vector<Row>{{"vertex front+left --by 0,0,-5", "vertex front.1 --by 0,0,-5"},
                                           {"vertex front.1 --by 0,0,-5", "vertex front.1 --to 50,50,-45"},
                                           {"vertex left.1 --by=0,0,-5", "vertex front.1 --by 0,0,-5mm"},
                                           {"edge base+front --by 0,-4,0", "edge base.1-2 --to 100,46,0"}}) {
        const Done one = edit(kTray, {row.one});
        const Done same = edit(kTray, {row.same});
        ASSERT_TRUE(one.text && same.text) << row.one << one.told << row.same << same.told;
        EXPECT_EQ(*one.text, *same.text) << row.one;
    }
}

TEST(EditDrawing, RefusesWithTheReason) {
    struct Row {
        std::string drawing, edit, told;
    };
    const std::string box = carton("straight_tuck_end(80, 50, 60, 0.5)");
    for (const Row& row : std::vector<Row>{
             {box, "extrude right --by -100", " would turn over"},
             {box, "extrude right --by -79", "would have no area, or cross itself"},
             {box, "extrude top --by 99999", "would be read otherwise than it is meant [edit-refused]"},
             {box, "extrude top --by 1e9", "'1e9' is no length [bad-edit]"},
             {box, "vertex front.2 --by nan,0,0", "'nan' is no length [bad-edit]"},
             {box, "vertex front.2 --by 0,inf,0", "'inf' is no length [bad-edit]"},
             {box, "extrude glue-flop --by 3", "the sheet has no panel \"glue-flop\" [bad-edit]"},
             {box, "vertex front+right --by 1,1,1", "2 vertices have all the panels of \"front+right\""},
             {box, "vertex front+back --by 1,1,1", "no vertex has all the panels of \"front+back\""},
             {tube(), "vertex front.1 --by 3,0,0", "would pass through"},
             {kTray, "extrude base --by -41", "would turn over"},
             {tube(), "edge top-flap-right.3-4 --by 0,0,20", "would lie over each other on the sheet by"},
             {tube(), "extrude lid --by 5", "the sheet has no panel \"lid\" [bad-edit]"},
             {tube(), "vertex front.77 --by 0,0,5", "front has no vertex 77: it has 1 to"},
             {tube(), "edge front+back --by 0,0,5", "there is no fold between front and back [bad-edit]"},
             {tube(), "vertex front.1 --by 5", "a place in space is three lengths, not '5' [bad-edit]"},
             {tube(), "vertex front.1", "vertex does not say how far [bad-edit]"},
             {tube(), "extrude --by 3", "extrude names nothing [bad-edit]"},
             {tube(), "turn front.1 --by 5", "there is no edit 'turn' of folded sheets [bad-edit]"}}) {
        const Done done = edit(row.drawing, {row.edit});
        EXPECT_FALSE(done.text) << row.edit;
        EXPECT_NE(done.told.find(row.told), std::string::npos) << row.edit << "\n" << done.told;
    }
}

TEST(EditDrawing, ForcedCarriesOutWhatCrosses) {
    DrawingEditOptions options;
    options.force = true;
    EXPECT_TRUE(edit(tube(), {"vertex front.1 --by 3,0,0"}, options).text);
}

}  // namespace
}  // namespace popup::test
