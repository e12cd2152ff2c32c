// Marks by which a sheet is found again, and the bar to measure: the same on print and cut, near the edges,
// and exactly as long as asked.
#include "fabrication/marks.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "output/sheet_drawing.h"
#include "output/svg.h"
#include "output/text_outlines.h"
#include "support/profiles.h"
#include "support/sheet_example.h"

namespace popup {
namespace {

using Part = SheetView::Part;
using test::options_for;
using test::view_of;

// --- marks

// Points of all marks of a view, without what is to be measured.
std::vector<Vec2> mark_points(const SheetDrawing& drawing) {
    std::vector<Vec2> all;
    for (const SheetShape& shape : drawing.shapes) {
        if (shape.operation != Operation::registration) continue;
        EXPECT_EQ(shape.piece, -1);
        for (const popup::Run& run : drawing.runs_of(shape)) {
            const auto points = drawing.points_of(run);
            all.insert(all.end(), points.begin(), points.end());
        }
    }
    return all;
}

TEST(SheetMarks, AreInTheSamePlacesOfPrintAndCut) {
    const Layout layout = test::example_layout();
    for (const Marks marks : {Marks::corners, Marks::silhouette}) {
        OutputOptions options = options_for("silhouette", true, ScoreSide::front, true);
        options.profile.marks = marks;
        options.reference_mm = 100.0;
        for (const bool back : {false, true}) {
            const auto print = mark_points(draw_sheet(layout, options, view_of(0, back, Part::print)));
            const auto cut = mark_points(draw_sheet(layout, options, view_of(0, back, Part::cut)));
            ASSERT_EQ(print.size(), cut.size());
            ASSERT_GE(print.size(), 10U);
            for (std::size_t i = 0; i < print.size(); ++i) EXPECT_LE(distance(print[i], cut[i]), 1e-9);
            // Silhouette's square is black all over.
            for (const Part part : {Part::print, Part::cut}) {
                int filled = 0;
                for (const SheetShape& shape : draw_sheet(layout, options, view_of(0, back, part)).shapes)
                    filled += shape.operation == Operation::registration && shape.filled ? 1 : 0;
                EXPECT_EQ(filled, marks == Marks::silhouette ? 1 : 0);
            }
        }
    }
}

// Silhouette's square stands in one corner only: mirrored, no machine would find it.
TEST(SheetMarks, AreInTheSamePlacesOfFrontAndBack) {
    const Layout layout = test::example_layout();
    for (const Marks marks : {Marks::corners, Marks::silhouette}) {
        OutputOptions options = options_for("silhouette", true, ScoreSide::front, true);
        options.profile.marks = marks;
        const auto front = mark_points(draw_sheet(layout, options, view_of(0, false, Part::cut)));
        const auto back = mark_points(draw_sheet(layout, options, view_of(0, true, Part::cut)));
        ASSERT_EQ(front.size(), back.size());
        for (std::size_t i = 0; i < front.size(); ++i) EXPECT_LE(distance(front[i], back[i]), 1e-9);
    }
}

// What is scored on a back needs marks that are printed there, though nothing else is.
TEST(SheetMarks, ArePrintedOnBacksThatAreWorkedOn) {
    const auto suffixes = [](Marks marks, ScoreSide side) {
        OutputOptions options = options_for("silhouette", false, side, true);
        options.profile.marks = marks;
        options.profile.folds = FoldStyle::score;
        Diagnostics diagnostics;
        const std::vector<SheetView> views = views_of(test::example_layout(), options, diagnostics).value();
        std::vector<std::string> all(views.size());
        std::transform(views.begin(), views.end(), all.begin(), [](const SheetView& v) { return v.suffix; });
        return all;
    };
    const auto prints_back = [](const std::vector<std::string>& all) {
        return std::count(all.begin(), all.end(), "-back-print");
    };
    EXPECT_EQ(prints_back(suffixes(Marks::silhouette, ScoreSide::both)), 1);
    EXPECT_EQ(prints_back(suffixes(Marks::silhouette, ScoreSide::front)), 0);
    EXPECT_EQ(prints_back(suffixes(Marks::none, ScoreSide::both)), 0);
}

// Marks are printed and looked for in the same place by the letter: the same text in both files.
TEST(SheetMarks, AreTheSameTextInBothFiles) {
    OutputOptions options = options_for("silhouette", false, ScoreSide::front, true);
    options.profile.marks = Marks::silhouette;
    Diagnostics diagnostics;
    const auto files = write_svg(test::example_layout(), options, diagnostics).value();
    ASSERT_EQ(files.size(), 4U);
    const auto marks = [](const std::string& svg) {
        const std::size_t at = svg.find("<g id=\"Regmarks\"");
        return at == std::string::npos ? "" : svg.substr(at, svg.find("</g>", at) - at);
    };
    EXPECT_NE(marks(files[0].bytes), "");
    EXPECT_EQ(marks(files[0].bytes), marks(files[2].bytes));
}

TEST(SheetMarks, KeepNearTheEdges) {
    for (const Marks marks : kMarks) {
        for (const Vec2 size : {Vec2{297, 210}, Vec2{215.9, 279.4}, Vec2{90, 70}}) {
            SCOPED_TRACE(to_string(marks));
            const std::vector<SheetMark> all = registration_marks(marks, size.x, size.y);
            EXPECT_EQ(all.empty(), marks == Marks::none);
            Box box;
            for (const SheetMark& mark : all) {
                for (const Vec2 p : mark.points) {
                    const double from_edge = std::min({p.x, p.y, size.x - p.x, size.y - p.y});
                    EXPECT_LE(from_edge, clear_of(marks) + 1e-9);
                    EXPECT_GE(from_edge, 4.0) << "printers do not reach the edge";
                    box.extend(p);
                }
                // Straight lines between points that keep within do so too: none goes across the sheet.
                for (std::size_t i = 1; i < mark.points.size(); ++i)
                    EXPECT_LE(distance(mark.points[i - 1], mark.points[i]), 20.0 + 1e-9);
            }
            if (all.empty()) continue;
            // As far apart as there is room.
            EXPECT_GE(box.width(), size.x - 2.0 * clear_of(marks));
            EXPECT_GE(box.height(), size.y - 2.0 * clear_of(marks));
            OutputOptions options;
            options.profile.marks = marks;
            EXPECT_EQ(margin_needed(options), clear_of(marks));
        }
    }
}

// A sheet that is turned must not look the same.
TEST(SheetMarks, TellWhichWayTheSheetLies) {
    for (const Marks marks : {Marks::corners, Marks::silhouette}) {
        const auto all = registration_marks(marks, 200, 200);
        const auto has = [&all](Vec2 p) {
            for (const SheetMark& mark : all) {
                for (const Vec2 q : mark.points) {
                    if (distance(p, q) < 1e-6) return true;
                }
            }
            return false;
        };
        bool the_same = true;
        for (const SheetMark& mark : all) {
            for (const Vec2 p : mark.points) the_same = the_same && has({200 - p.x, 200 - p.y});
        }
        EXPECT_FALSE(the_same);
    }
}

// --- the bar to measure

TEST(ReferenceBar, IsExactlyAsLongAsAsked) {
    if (!can_outline_text()) GTEST_SKIP() << "the font of labels is not installed";
    for (const double mm : {1.0, 25.4, 50.5, 100.0, 123.456, 233.0}) {
        for (const bool back : {false, true}) {
            SCOPED_TRACE(mm);
            Layout layout = test::example_layout();
            layout.margin_mm = back ? 12.0 : 5.0;
            OutputOptions options = options_for("workshop", true, ScoreSide::front, false);
            options.reference_mm = mm;
            EXPECT_EQ(margin_needed(options), 5.0);
            const SheetDrawing drawing = draw_sheet(layout, options, view_of(0, back));
            std::vector<Segment> lines;
            for (const SheetShape& shape : drawing.shapes) {
                if (shape.operation != Operation::registration) continue;
                const auto points = drawing.points_of(drawing.runs_of(shape).front());
                ASSERT_EQ(points.size(), 2U);
                lines.push_back({points[0], points[1]});
            }
            ASSERT_EQ(lines.size(), 3U);
            std::vector<double> ticks;
            double low = HUGE_VAL;
            double high = -HUGE_VAL;
            for (const Segment& one : lines) {
                for (const Vec2 p : {one.a, one.b}) {
                    low = std::min(low, p.y);
                    high = std::max(high, p.y);
                    // In the margin, clear of pieces, and where printers print.
                    EXPECT_GT(p.y, 1.5);
                    EXPECT_LT(p.y, layout.margin_mm - 0.5);
                }
                if (one.a.x == one.b.x) {
                    ticks.push_back(one.a.x);
                } else {
                    EXPECT_NEAR(std::abs(one.a.x - one.b.x), mm, 1e-9);
                    EXPECT_EQ(one.a.y, one.b.y);
                }
            }
            ASSERT_EQ(ticks.size(), 2U);
            EXPECT_NEAR(std::abs(ticks[0] - ticks[1]), mm, 1e-9);
            EXPECT_GT(high - low, 1.0);
            // Its figure stands beside it.
            std::vector<SheetText> figures;
            for (const SheetText& text : drawing.texts) {
                if (text.operation == Operation::registration) figures.push_back(text);
            }
            ASSERT_EQ(figures.size(), 1U);
            EXPECT_EQ(std::stod(figures[0].text), mm);
            EXPECT_TRUE(figures[0].text.ends_with(" mm"));
            EXPECT_EQ(figures[0].angle, 0.0);
            Box ink;
            for (const Ring& ring :
                 text_outlines(figures[0].text, figures[0].at, figures[0].cap_mm, figures[0].angle)) {
                for (const Vec2 p : ring) ink.extend(p);
            }
            ASSERT_FALSE(ink.empty());
            EXPECT_TRUE(ink.min.x > std::max(ticks[0], ticks[1]) + 0.2 ||
                        ink.max.x < std::min(ticks[0], ticks[1]) - 0.2);
            EXPECT_GT(ink.min.x, 5.0);
            EXPECT_LT(ink.max.x, drawing.width_mm - 5.0);
        }
    }
}

TEST(ReferenceBar, KeepsClearOfTheMarks) {
    for (const Marks marks : {Marks::corners, Marks::silhouette}) {
        for (const double width : {150.0, 297.0, 841.0}) {
            const double longest = longest_reference(width);
            const ReferenceBar bar = reference_bar(longest, width, clear_of(marks));
            std::vector<SheetMark> all = bar.lines;
            for (const Ring& ring : text_outlines("888.888 mm", bar.figure_at, kFigureMm, 0.0))
                all.push_back({ring, true, true});
            for (const SheetMark& line : all) {
                for (const SheetMark& mark : registration_marks(marks, width, 210)) {
                    const std::size_t n = mark.points.size();
                    for (std::size_t i = 0; i + (mark.closed ? 0 : 1) < n; ++i) {
                        const Segment one{mark.points[i], mark.points[(i + 1) % n]};
                        for (std::size_t k = 1; k < line.points.size(); ++k)
                            EXPECT_GT(distance(Segment{line.points[k - 1], line.points[k]}, one), 0.9);
                    }
                }
            }
        }
    }
}

TEST(ReferenceBar, ThatIsTooLongForASheetIsAnError) {
    Layout layout = test::example_layout();
    layout.sheets[1].width_mm = 200.0;  // the narrower one decides
    OutputOptions options;
    options.reference_mm = longest_reference(200.0);
    Diagnostics diagnostics;
    EXPECT_TRUE(views_of(layout, options, diagnostics).has_value());
    EXPECT_FALSE(diagnostics.has_errors());
    options.reference_mm += 0.001;
    EXPECT_FALSE(views_of(layout, options, diagnostics).has_value());
    ASSERT_EQ(diagnostics.sorted().size(), 1U);
    EXPECT_EQ(diagnostics.sorted()[0].code, "reference-too-long");
    EXPECT_EQ(diagnostics.sorted()[0].severity, Severity::error);
    // No bar always fits.
    layout.sheets[1].width_mm = 20.0;
    options.reference_mm = 0.0;
    EXPECT_TRUE(views_of(layout, options, diagnostics).has_value());
}

// Who asks for the length that the message offers gets it.
TEST(ReferenceBar, ErrorNamesALengthThatFits) {
    for (const double width : {215.9, 297.0, 210.6, 431.8}) {
        Layout layout = test::example_layout();
        layout.sheets[0].width_mm = width;
        layout.sheets[1].width_mm = width;
        OutputOptions options;
        options.reference_mm = 5000.0;
        Diagnostics diagnostics;
        EXPECT_FALSE(views_of(layout, options, diagnostics).has_value());
        const std::string message = diagnostics.sorted().at(0).message;
        const std::string words = "room for ";
        ASSERT_NE(message.find(words), std::string::npos) << message;
        options.reference_mm = std::stod(message.substr(message.find(words) + words.size()));
        EXPECT_GT(options.reference_mm, width - 70.0);
        EXPECT_TRUE(views_of(layout, options, diagnostics).has_value()) << message;
    }
}

}  // namespace
}  // namespace popup
