// What sheets say so that a card can be built from them alone: marks of machines, joints and the legend.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "output/sheet_drawing.h"
#include "output/stroked_text.h"
#include "output/svg.h"
#include "support/profiles.h"
#include "support/sheet_example.h"

namespace popup {
namespace {

using test::options_for;
using test::view_of;

std::size_t marks_on(const Layout& layout, const OutputOptions& options, int sheet, bool back) {
    const SheetDrawing drawing = draw_sheet(layout, options, view_of(sheet, back));
    return static_cast<std::size_t>(
        std::count_if(drawing.shapes.begin(), drawing.shapes.end(),
                      [](const SheetShape& one) { return one.operation == Operation::mark; }));
}

// The findings with that code, each followed by its first hint.
std::vector<std::string> told_of(std::string_view code, const Layout& layout, const OutputOptions& options) {
    Diagnostics diagnostics;
    examine_prints(layout, options, diagnostics);
    std::vector<std::string> told;
    for (const Diagnostic& one : diagnostics.sorted()) {
        if (one.code == code) told.push_back(one.message + "; " + one.hints.front());
    }
    return told;
}

// --- marks

TEST(GlueMarks, AreWhereTheTabCoversThem) {
    const Layout layout = test::example_layout();
    OutputOptions options = options_for("lightburn", false, ScoreSide::front, false);
    // Four corners of the target and its number; on the second sheet a number for each of two houses.
    EXPECT_EQ(marks_on(layout, options, 0, false), 5U);
    EXPECT_EQ(marks_on(layout, options, 1, false), 2U);
    EXPECT_EQ(marks_on(layout, options, 0, true), 0U);
    options.profile.marks_on = MarksOn::front;  // and the names
    EXPECT_EQ(marks_on(layout, options, 0, false), 6U);
    EXPECT_EQ(marks_on(layout, options, 1, false), 4U);
    options.profile.marks_on = MarksOn::back;
    EXPECT_EQ(marks_on(layout, options, 0, false), 0U);
    EXPECT_EQ(marks_on(layout, options, 0, true), 6U);
    options.profile.marks_on = MarksOn::none;
    EXPECT_EQ(marks_on(layout, options, 0, false) + marks_on(layout, options, 0, true), 0U);
}

TEST(GlueMarks, HideNamesOnTheBackWhereTheMachineWorksThereAnyway) {
    const Layout layout = test::example_layout();
    const OutputOptions both = options_for("lightburn", false, ScoreSide::both, false);
    EXPECT_EQ(marks_on(layout, both, 0, false), 5U);
    EXPECT_EQ(marks_on(layout, both, 0, true), 1U);
    const OutputOptions back = options_for("lightburn", false, ScoreSide::back, false);
    EXPECT_EQ(marks_on(layout, back, 0, true), 6U);
}

TEST(GlueMarks, AreNotMadeOfWhatIsPrinted) {
    const Layout layout = test::example_layout();
    for (const std::string_view name : {"workshop", "silhouette", "print-and-cut"})
        EXPECT_EQ(marks_on(layout, options_for(name, false, ScoreSide::front, false), 0, false), 0U) << name;
    const OutputOptions apart = options_for("lightburn", false, ScoreSide::front, true);
    for (const auto part : {SheetView::Part::print, SheetView::Part::cut}) {
        const SheetDrawing drawing = draw_sheet(layout, apart, view_of(0, false, part));
        for (const SheetShape& one : drawing.shapes) EXPECT_NE(one.operation, Operation::mark);
    }
}

// No built-in profile loses what a glued card is built by.
TEST(GlueMarks, OrPrintsAreInEveryProfile) {
    const Layout layout = test::example_layout();
    for (const Profile& profile : profile_table()) {
        OutputOptions options;
        options.profile = profile;
        const bool prints = profile.draws(Operation::glue) && profile.draws(Operation::label);
        EXPECT_TRUE(prints || marks_on(layout, options, 0, false) >= 5U) << profile.name;
        Diagnostics diagnostics;
        examine_prints(layout, options, diagnostics);
        for (const Diagnostic& one : diagnostics.sorted()) EXPECT_NE(one.code, "glue-marks-left-out");
    }
}

TEST(GlueMarks, ThatAreLeftOutAreTold) {
    OutputOptions options = options_for("lightburn", false, ScoreSide::front, false);
    options.profile.pens[static_cast<std::size_t>(Operation::mark)].layer.clear();
    Diagnostics diagnostics;
    examine_prints(test::example_layout(), options, diagnostics);
    const auto found = diagnostics.sorted();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].code, "glue-marks-left-out");
    EXPECT_EQ(found[0].message,
              "the sheets by the profile lightburn lack 1 glue target and 2 numbers of tabs");
    options.print_and_cut = true;  // the files of prints have them
    Diagnostics none;
    examine_prints(test::example_layout(), options, none);
    EXPECT_TRUE(none.sorted().empty());
}

// What is glued flat is numbered on backs; that these come before the fronts is told where nobody asked for
// them.
TEST(GlueMarks, OnBacksThatNobodyAskedForAreTold) {
    Layout layout = test::example_layout();
    layout.designs[0].pattern.pieces[0].targets.push_back(
        {test::rectangle(-80, -40, -60, -20), 0, "2", true});
    const auto told = [&](const OutputOptions& options) { return told_of("backs-to-mark", layout, options); };
    OutputOptions options = options_for("lightburn", false, ScoreSide::front, false);
    const std::vector<std::string> none;
    EXPECT_EQ(told(options),
              std::vector<std::string>{
                  "1 sheet has a mirrored back, with marks of what is glued there; mark the back first "
                  "(the file whose name ends in -back; in PDF the page after the front), turn the sheet over "
                  "from left to right, and cut the front; --marks-on none leaves all marks out"});
    for (const MarksOn asked : {MarksOn::none, MarksOn::front, MarksOn::back}) {
        options.profile.marks_on = asked;
        EXPECT_EQ(told(options), none);
    }
    EXPECT_EQ(told(options_for("lightburn", true, ScoreSide::front, false)), none);
    EXPECT_EQ(told(options_for("workshop", false, ScoreSide::front, false)), none);
    layout = test::example_layout();
    EXPECT_EQ(told(options_for("lightburn", false, ScoreSide::front, false)), none);
}

// What is glued to a back is marked where it is glued, or it is told that it is not.
TEST(GlueMarks, OfBacksAreOnBacksAlone) {
    Layout layout = test::example_layout();
    PatternPiece& page = layout.designs[0].pattern.pieces[0];
    page.targets.push_back({test::rectangle(-80, -40, -60, -20), 0, "2", true});
    page.labels.push_back({LabelKind::target, "2", {-70, -30}, 3.0, 0.0, true});
    OutputOptions options = options_for("lightburn", false, ScoreSide::front, false);
    EXPECT_EQ(marks_on(layout, options, 0, false), 5U);
    options.profile.marks_on = MarksOn::back;
    EXPECT_EQ(marks_on(layout, options, 0, true), 11U);
    const auto printed_on = [&](bool backs, bool back) {
        const SheetDrawing drawing =
            draw_sheet(layout, options_for("workshop", backs, ScoreSide::front, false), view_of(0, back));
        return std::count_if(drawing.shapes.begin(), drawing.shapes.end(),
                             [](const SheetShape& one) { return one.operation == Operation::glue; }) +
               std::count_if(drawing.texts.begin(), drawing.texts.end(),
                             [](const SheetText& one) { return one.text == "2"; });
    };
    EXPECT_EQ(printed_on(false, false), 1);
    EXPECT_EQ(printed_on(true, true), 3);
    const auto told = [&](const OutputOptions& of) { return told_of("glue-marks-left-out", layout, of); };
    const std::vector<std::string> none;
    EXPECT_EQ(told(options), none);
    // What is glued there covers them: four corners and the number.
    options.profile.marks_on = MarksOn::hidden;
    EXPECT_EQ(told(options), none);
    EXPECT_EQ(marks_on(layout, options, 0, false), 5U);
    EXPECT_EQ(marks_on(layout, options, 0, true), 5U);
    EXPECT_EQ(told(options_for("workshop", true, ScoreSide::front, false)), none);
    EXPECT_EQ(told(options_for("workshop", false, ScoreSide::front, false)),
              std::vector<std::string>{"the sheets by the profile workshop lack 1 glue target on backs; take "
                                       "--sides both, which prints them on the backs"});
}

// A piece that is glued flat has its number where it is glued, on a sheet of backs that has nothing else.
TEST(GlueMarks, NumberWhatIsGluedFlatOnItsBack) {
    Layout layout = test::example_layout();
    PatternPiece& house = layout.designs[0].pattern.pieces[1];
    house.number = "2";
    house.labels = {{LabelKind::piece, "2. house", {-20, 30}, 4.0, 0.0}};
    const auto backs = [&](const OutputOptions& options) {
        Diagnostics diagnostics;
        const auto views = views_of(layout, options, diagnostics);
        return std::count_if(views->begin(), views->end(), [](const SheetView& one) { return one.back; });
    };
    const auto lacking = [&](const OutputOptions& options) {
        return told_of("glue-marks-left-out", layout, options).size();
    };
    OutputOptions options = options_for("lightburn", false, ScoreSide::front, false);
    EXPECT_EQ(backs(options), 0);
    EXPECT_EQ(lacking(options), 1U);
    house.hidden_number = Label{LabelKind::piece, "2", {-20, 30}, 3.0, 0.0, true};
    EXPECT_EQ(backs(options), 1);  // of the sheet with the houses
    EXPECT_EQ(lacking(options), 0U);
    EXPECT_EQ(marks_on(layout, options, 1, false), 0U);
    EXPECT_EQ(marks_on(layout, options, 1, true), 2U);  // of two houses
    EXPECT_EQ(marks_on(layout, options, 0, true), 0U);
    // The mark is where the number is, seen when the sheet is turned over.
    const SheetDrawing drawing = draw_sheet(layout, options, view_of(1, true));
    Box box;
    for (const popup::Run& run : drawing.runs_of(drawing.shapes.front())) {
        for (const Vec2 p : drawing.points_of(run)) box.extend(p);
    }
    const Vec2 middle = box.centre();
    const auto off = [&](int placement) {
        const Vec2 front = layout.placements.at(static_cast<std::size_t>(placement)).apply({-20, 30});
        return distance(middle, Vec2{297 - front.x, front.y});
    };
    EXPECT_LT(std::min(off(1), off(2)), 1.0);
    // Where names are marked on backs they have the number.
    const OutputOptions both = options_for("lightburn", false, ScoreSide::both, false);
    EXPECT_EQ(marks_on(layout, both, 1, true), 2U);
    EXPECT_EQ(marks_on(layout, options_for("lightburn", false, ScoreSide::back, false), 1, true), 2U);
    // On its front where that is glued.
    house.hidden_number->on_back = false;
    EXPECT_EQ(backs(options), 0);
    EXPECT_EQ(marks_on(layout, options, 1, false), 2U);
}

// Numbers of pieces are those of their own card.
TEST(GlueMarks, NameTheCardWhereSeveralAreOnTheSheets) {
    Layout layout = test::example_layout();
    layout.prefix_names = true;
    const auto names = [&] {
        const SheetDrawing drawing =
            draw_sheet(layout, options_for("workshop", false, ScoreSide::front, false), view_of(0, false));
        std::vector<SheetText> all;
        for (const SheetText& one : drawing.texts) {
            if (one.operation == Operation::label) all.push_back(one);
        }
        return all;
    };
    const std::vector<SheetText> named = names();
    ASSERT_EQ(named.size(), 2U);
    EXPECT_EQ(named[0].text, "page") << "too small to be read with it";
    layout.designs[0].stem = "a";
    const std::vector<SheetText> fits = names();
    EXPECT_EQ(fits[0].text, "a: page");
    EXPECT_NEAR(fits[0].cap_mm, 4.0 * 3.8 / 6.2, 1e-9) << "as wide as the name was";
    EXPECT_EQ(fits[1].text, "1R");
    // Where there is room it is wider, and no higher.
    layout.designs[0].pattern.pieces[0].labels[0].room = 3.0;
    EXPECT_NEAR(names()[0].cap_mm, 4.0, 1e-9);
}

TEST(StrokedText, IsCentredAndAsHighAsAsked) {
    const Vec2 at{30, 20};
    Box box;
    for (const StrokedLine& line : stroked_text("10R", at, 4.0, 0.0)) {
        EXPECT_FALSE(line.closed);
        for (const Vec2 p : line.points) box.extend(p);
    }
    EXPECT_NEAR(box.min.y, 18.0, 1e-9);
    EXPECT_NEAR(box.max.y, 22.0, 1e-9);
    EXPECT_NEAR(0.5 * (box.min.x + box.max.x), at.x, 1.0);
    // A letter that the font does not have is an outline.
    const auto foreign = stroked_text("\u00e9", at, 4.0, 0.0);
    ASSERT_FALSE(foreign.empty());
    EXPECT_TRUE(foreign.front().closed);
}

// --- joints

TEST(SheetJoints, HoldEveryPieceAndAreCounted) {
    const Layout layout = test::windowed_layout();
    for (const std::string_view name : {"workshop", "lightburn"}) {
        OutputOptions options = options_for(name, false, ScoreSide::front, false);
        for (const int sheet : {0, 1}) {
            const SheetDrawing whole = draw_sheet(layout, options, view_of(sheet, false));
            options.profile.joint_mm = 0.4;
            const SheetDrawing held = draw_sheet(layout, options, view_of(sheet, false));
            options.profile.joint_mm = 0.0;
            const auto length = [](const SheetDrawing& drawing, Operation operation) {
                double sum = 0.0;
                for (const SheetShape& one : drawing.shapes)
                    sum += one.operation == operation ? drawing.length_of(one) : 0.0;
                return sum;
            };
            EXPECT_GE(held.joints, 2 * held.pieces.size());
            EXPECT_TRUE(held.loose_pieces.empty());
            EXPECT_NEAR(length(whole, Operation::outer_cut) - length(held, Operation::outer_cut),
                        0.4 * static_cast<double>(held.joints), 1e-6);
            // What falls out of a piece is waste.
            EXPECT_DOUBLE_EQ(length(whole, Operation::inner_cut), length(held, Operation::inner_cut));
        }
    }
}

// The strip between a hole and the edge is too weak for a joint.
TEST(SheetJoints, AreNotBesideHolesAndSlits) {
    Layout layout = test::example_layout();
    PatternPiece& page = layout.designs[0].pattern.pieces[0];
    // Along all edges, but for the middle of the left one.
    page.cuts.insert(page.cuts.begin(), {{{-99.5, -10}, {-99.5, -79.5}, {0, -79.5}}, false, 1});
    page.cuts.insert(page.cuts.begin(), {test::rectangle(0, -79.5, 99.5, 79.5), true, 1});
    page.cuts.insert(page.cuts.begin(), {{{-99.5, 10}, {-99.5, 79.5}, {0, 79.5}}, false, 1});
    OutputOptions options = options_for("lightburn", false, ScoreSide::front, false);
    options.profile.joint_mm = 0.4;
    const SheetDrawing drawing = draw_sheet(layout, options, view_of(0, false));
    const Vec2 middle = layout.placements[0].apply({-100, 0});
    std::size_t ends = 0;
    for (const SheetShape& one : drawing.shapes) {
        if (one.operation != Operation::outer_cut) continue;
        for (const popup::Run& run : drawing.runs_of(one)) {
            EXPECT_FALSE(run.closed);
            for (const Vec2 end : {drawing.points_of(run).front(), drawing.points_of(run).back()}) {
                ++ends;
                EXPECT_LT(distance(end, middle), 10.0);
            }
        }
    }
    EXPECT_EQ(ends, 2 * drawing.joints);
    EXPECT_GE(drawing.joints, 2U);
}

// Else the slug of the hole falls, and the piece in it with it.
TEST(SheetJoints, HoldTheHoleInWhichAPieceLies) {
    Layout layout = test::example_layout();
    PatternPiece& page = layout.designs[0].pattern.pieces[0];
    page.cuts = {{test::rectangle(-95, -75, 95, 75), true, 1},
                 {test::rectangle(-98, 76, -90, 79), true, 1},
                 {test::rectangle(-100, -80, 100, 80), true}};
    page.lines.clear();
    for (const bool machine_order : {false, true}) {
        OutputOptions options = options_for("lightburn", false, ScoreSide::front, false);
        options.profile.machine_order = machine_order;
        options.profile.joint_mm = 0.4;
        const std::size_t alone = draw_sheet(layout, options, view_of(0, false)).joints;
        Layout nested = layout;
        nested.placements[1].sheet = 0;
        nested.placements[1].offset = nested.placements[0].offset;
        const SheetDrawing drawing = draw_sheet(nested, options, view_of(0, false));
        EXPECT_TRUE(drawing.loose_pieces.empty());
        std::size_t closed = 0;
        for (const SheetShape& one : drawing.shapes) {
            if (!is_cut(one.operation)) continue;
            for (const popup::Run& run : drawing.runs_of(one)) closed += run.closed ? 1 : 0;
        }
        EXPECT_EQ(closed, 1U) << "the small hole alone falls";
        EXPECT_GE(drawing.joints, alone + 4);
    }
}

TEST(SheetJoints, ThatAPieceHasNoRoomForAreTold) {
    OutputOptions options = options_for("lightburn", false, ScoreSide::front, false);
    options.profile.joint_mm = 9.0;
    Layout layout = test::example_layout();
    PatternPiece& house = layout.designs[0].pattern.pieces[1];
    house.cuts = {{test::rectangle(0, 0, 8, 8), true}};
    house.lines.clear();
    Diagnostics diagnostics;
    examine_prints(layout, options, diagnostics);
    const auto found = diagnostics.sorted();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].code, "too-few-joints");
    EXPECT_EQ(found[0].message,
              "the outer cuts of \"house\" and 1 more piece have no room for two joints of 9 mm clear of "
              "corners, folds and holes");
}

// --- legend

Box legend_box(const SheetDrawing& drawing) {
    Box box;
    for (const SheetShape& one : drawing.shapes) {
        if (one.operation != Operation::legend) continue;
        for (const popup::Run& run : drawing.runs_of(one)) {
            for (const Vec2 p : drawing.points_of(run)) box.extend(p);
        }
    }
    return box;
}

TEST(SheetLegend, LiesBesideThePiecesAndInsideTheMargins) {
    const Layout layout = test::example_layout();
    OutputOptions options;
    options.legend = Legend::automatic;
    for (const int sheet : {0, 1}) {
        const SheetDrawing drawing = draw_sheet(layout, options, view_of(sheet, false));
        const Box box = legend_box(drawing);
        ASSERT_FALSE(box.empty()) << sheet;
        EXPECT_GE(box.min.x, 5.0);
        EXPECT_GE(box.min.y, 5.0);
        EXPECT_LE(box.max.x, 292.0);
        EXPECT_LE(box.max.y, 205.0);
        for (const SheetShape& one : drawing.shapes) {
            if (one.operation == Operation::legend) continue;
            for (const popup::Run& run : drawing.runs_of(one)) {
                const auto points = drawing.points_of(run);
                for (std::size_t i = 0; i < points.size(); ++i) {
                    for (int k = 0; k <= 20; ++k) {
                        const Vec2 p = lerp(points[i], points[(i + 1) % points.size()], k / 20.0);
                        EXPECT_FALSE(p.x > box.min.x && p.x < box.max.x && p.y > box.min.y &&
                                     p.y < box.max.y);
                    }
                }
            }
        }
        std::vector<std::string> texts;
        for (const SheetText& text : drawing.texts) {
            if (text.operation != Operation::legend) continue;
            texts.push_back(text.text);
            EXPECT_GT(text.at.x, box.min.x);
            EXPECT_LT(text.at.x, box.max.x);
        }
        ASSERT_GE(texts.size(), 4U);
        EXPECT_EQ(texts[0], "castle, sheet " + std::to_string(sheet + 1) + " of 2");
        EXPECT_NE(std::find(texts.begin(), texts.end(), "50 mm: print at 100 %"), texts.end());
    }
}

TEST(SheetLegend, SaysWhichSheetItIsOfHoweverLongTheName) {
    const Layout layout = test::example_layout(std::string(100, 'n'));
    OutputOptions options;
    options.legend = Legend::automatic;
    const SheetDrawing drawing = draw_sheet(layout, options, view_of(1, false));
    const auto first = std::find_if(drawing.texts.begin(), drawing.texts.end(),
                                    [](const SheetText& one) { return one.operation == Operation::legend; });
    ASSERT_NE(first, drawing.texts.end());
    EXPECT_EQ(first->text, std::string(60, 'n') + "..., sheet 2 of 2");
}

// What all sheets say of the layout is found once a file, not once a sheet.
TEST(SheetLegend, AsksWhatIsFoldedOnceAFile) {
    Layout layout = test::example_layout();
    OutputOptions options;
    options.legend = Legend::automatic;
    Diagnostics diagnostics;
    for (const bool folded : {true, false}) {
        const auto views = views_of(layout, options, diagnostics);
        ASSERT_TRUE(views);
        for (const SheetView& view : *views) {
            EXPECT_EQ(view.folded_or_glued, folded);
            EXPECT_EQ(legend_box(draw_sheet(layout, options, view)).empty(), !folded);
        }
        for (PatternPiece& piece : layout.designs[0].pattern.pieces) {
            piece.lines.clear();
            piece.targets.clear();
        }
    }
}

TEST(SheetLegend, IsOffForMachinesAndWhenNotWanted) {
    const Layout layout = test::example_layout();
    OutputOptions options;
    EXPECT_TRUE(legend_box(draw_sheet(layout, options, view_of(0, false))).empty());
    for (const Profile& profile : profile_table()) {
        if (profile.name == "workshop") continue;
        options.legend = Legend::always;
        options.profile = profile;
        EXPECT_TRUE(legend_box(draw_sheet(layout, options, view_of(0, false))).empty()) << profile.name;
    }
}

TEST(SheetLegend, ThatAProfileLeavesOutIsTold) {
    OutputOptions options = options_for("lightburn", false, ScoreSide::front, false);
    options.legend = Legend::always;
    Diagnostics diagnostics;
    examine_prints(test::example_layout(), options, diagnostics);
    const auto found = diagnostics.sorted();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].code, "prints-left-out");
    EXPECT_EQ(found[0].message, "the profile lightburn leaves out the legend");
}

TEST(SheetLegend, WithoutRoomIsToldWhenItIsAlwaysWanted) {
    Layout layout = test::example_layout();
    layout.sheets[0] = {210, 170, 0.9, {200, 160}};
    layout.placements[0].offset = {105, 85};
    OutputOptions options;
    options.legend = Legend::automatic;
    Diagnostics none;
    examine_prints(layout, options, none);
    EXPECT_TRUE(none.sorted().empty());
    options.legend = Legend::always;
    Diagnostics diagnostics;
    examine_prints(layout, options, diagnostics);
    const auto found = diagnostics.sorted();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].code, "legend-left-out");
    EXPECT_EQ(found[0].message, "sheet 1 has no room for the legend beside the pieces");
}

}  // namespace
}  // namespace popup
