// Which pictures of sheets there are, what is on which side, and how backs lie to fronts. What is expected is
// written out here, or worked out from the pattern.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "output/sheet_drawing.h"
#include "output/svg.h"
#include "support/profiles.h"
#include "support/sheet_example.h"

namespace popup {
namespace {

using Part = SheetView::Part;
using test::options_for;
using test::view_of;
using Operations = std::set<Operation>;

std::vector<SheetView> views(const Layout& layout, const OutputOptions& options) {
    Diagnostics diagnostics;
    std::vector<SheetView> all = views_of(layout, options, diagnostics).value();
    EXPECT_TRUE(diagnostics.sorted().empty());
    return all;
}

Operations operations_on(const SheetDrawing& drawing) {
    Operations all;
    for (const SheetShape& shape : drawing.shapes) all.insert(shape.operation);
    for (const SheetText& text : drawing.texts) all.insert(text.operation);
    return all;
}

// "0f" is the front of the first sheet, "1bc" the cuts of the second's back, "p" what is printed; after it
// the suffix.
std::vector<std::string> listed(const std::vector<SheetView>& all) {
    std::vector<std::string> list;
    for (const SheetView& view : all) {
        list.push_back(std::to_string(view.sheet) + (view.back ? "b" : "f") +
                       (view.part == Part::print ? "p"
                        : view.part == Part::cut ? "c"
                                                 : "") +
                       " " + view.suffix);
        EXPECT_EQ(view.part_suffix, view.part == Part::print ? "-print"
                                    : view.part == Part::cut ? "-cut"
                                                             : "");
    }
    return list;
}

TEST(SheetViews, AreTheSidesThatHaveSomethingOnThem) {
    using List = std::vector<std::string>;
    struct Row {
        const char* profile;
        bool backs;
        ScoreSide side;
        bool apart;
        List expected;
    };
    const List fronts{"0f ", "1f -2"};
    const List both_sides{"0f ", "0b -back", "1f -2", "1b -2-back"};
    const List backs_alone{"0b ", "1b -2"};
    const List prints{"0fp -print", "1fp -2-print"};
    const List both_prints{"0fp -print", "0bp -back-print", "1fp -2-print", "1bp -2-back-print"};
    const List cuts{"0fc -cut", "1fc -2-cut"};
    const List both_cuts{"0fc -cut", "0bc -back-cut", "1fc -2-cut", "1bc -2-back-cut"};
    const List back_cuts{"0bc -cut", "1bc -2-cut"};
    const auto then = [](List first, const List& second) {
        first.insert(first.end(), second.begin(), second.end());
        return first;
    };
    const std::vector<Row> table{
        {"workshop", false, ScoreSide::front, false, fronts},
        {"workshop", false, ScoreSide::back, false, both_sides},
        {"workshop", false, ScoreSide::both, false, both_sides},
        {"workshop", true, ScoreSide::front, false, both_sides},
        {"workshop", true, ScoreSide::back, false, both_sides},
        {"workshop", true, ScoreSide::both, false, both_sides},
        {"workshop", false, ScoreSide::front, true, then(prints, cuts)},
        {"workshop", false, ScoreSide::back, true, then(prints, back_cuts)},
        {"workshop", false, ScoreSide::both, true, then(prints, both_cuts)},
        {"workshop", true, ScoreSide::front, true, then(both_prints, cuts)},
        {"workshop", true, ScoreSide::back, true, then(both_prints, back_cuts)},
        {"workshop", true, ScoreSide::both, true, then(both_prints, both_cuts)},
        // Nothing is printed by its pens.
        {"generic-laser", false, ScoreSide::front, false, fronts},
        {"generic-laser", false, ScoreSide::back, false, backs_alone},
        {"generic-laser", false, ScoreSide::both, false, both_sides},
        {"generic-laser", true, ScoreSide::front, false, fronts},
        {"generic-laser", true, ScoreSide::back, false, backs_alone},
        {"generic-laser", true, ScoreSide::back, true, then(both_prints, back_cuts)},
        // Folds are perforated: there is no valley fold that would be scored from the back.
        {"silhouette", false, ScoreSide::both, true, then(prints, cuts)},
        {"silhouette", true, ScoreSide::both, false, both_sides},
    };
    const Layout layout = test::example_layout();
    for (const Row& row : table) {
        SCOPED_TRACE(std::string(row.profile) + (row.backs ? " backs" : "") + (row.apart ? " apart" : "") +
                     " side " + std::to_string(static_cast<int>(row.side)));
        const OutputOptions options = options_for(row.profile, row.backs, row.side, row.apart);
        const std::vector<SheetView> all = views(layout, options);
        EXPECT_EQ(listed(all), row.expected);
        // The files of a writer are these.
        Diagnostics diagnostics;
        const auto files = write_svg(layout, options, diagnostics).value();
        ASSERT_EQ(files.size(), all.size());
        for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(files[i].suffix, all[i].suffix);
        // Part by part.
        std::size_t count = 0;
        for (const std::span<const SheetView> part : parts_of(all)) {
            for (const SheetView& view : part) EXPECT_EQ(view.part, part.front().part);
            count += part.size();
        }
        EXPECT_EQ(count, all.size());
        EXPECT_EQ(parts_of(all).size(), row.apart ? 2U : 1U);
    }
}

TEST(SheetViews, OfNothingAreAFront) {
    Layout layout;
    layout.sheets = {{100, 80, 0.0, {}}};
    for (const bool apart : {false, true}) {
        const auto all = views(layout, options_for("workshop", true, ScoreSide::both, apart));
        EXPECT_EQ(all.size(), apart ? 2U : 1U);
        for (const SheetView& view : all) EXPECT_FALSE(view.back);
    }
    layout.sheets.clear();
    EXPECT_TRUE(views(layout, OutputOptions{}).empty());
}

TEST(SheetViews, HaveOnEachSideWhatBelongsThere) {
    using enum Operation;
    const Layout layout = test::example_layout();
    const Operations art{fill, draw};
    const Operations notes{glue, label};
    const auto plus = [](Operations a, const Operations& b) {
        a.insert(b.begin(), b.end());
        return a;
    };
    // The page, on the first sheet, has no seam.
    const Operations machine{valley, mountain, inner_cut, outer_cut};
    const Operations but_valleys{mountain, inner_cut, outer_cut};
    struct Row {
        bool backs;
        ScoreSide side;
        Operations front;
        Operations back;
    };
    const std::vector<Row> table{
        {false, ScoreSide::front, plus(plus(art, notes), machine), {}},
        {false, ScoreSide::back, plus(art, notes), machine},
        {false, ScoreSide::both, plus(plus(art, notes), but_valleys), {valley}},
        {true, ScoreSide::front, plus(art, machine), plus(art, notes)},
        {true, ScoreSide::back, art, plus(plus(art, notes), machine)},
        {true, ScoreSide::both, plus(art, but_valleys), plus(plus(art, notes), {valley})},
    };
    for (const Row& row : table) {
        SCOPED_TRACE((row.backs ? "backs, side " : "side ") + std::to_string(static_cast<int>(row.side)));
        OutputOptions options = options_for("workshop", row.backs, row.side, false);
        EXPECT_EQ(operations_on(draw_sheet(layout, options, view_of(0, false))), row.front);
        EXPECT_EQ(operations_on(draw_sheet(layout, options, view_of(0, true))), row.back);
        // In files of their own both have the marks, and together what is on the side.
        options.print_and_cut = true;
        options.profile.marks = Marks::corners;
        for (const bool back : {false, true}) {
            const Operations print =
                operations_on(draw_sheet(layout, options, view_of(0, back, Part::print)));
            const Operations cut = operations_on(draw_sheet(layout, options, view_of(0, back, Part::cut)));
            EXPECT_TRUE(print.contains(registration) && cut.contains(registration));
            for (const Operation one : print) EXPECT_TRUE(is_printed(one));
            for (const Operation one : cut) EXPECT_TRUE(one == registration || !is_printed(one));
            Operations all = plus(print, cut);
            all.erase(registration);
            EXPECT_EQ(all, back ? row.back : row.front);
        }
    }
}

TEST(SheetViews, PrintWhatTheMachinesPensLeaveOut) {
    const Layout layout = test::example_layout();
    const OutputOptions options = options_for("generic-laser", false, ScoreSide::front, true);
    const SheetDrawing print = draw_sheet(layout, options, view_of(0, false, Part::print));
    EXPECT_EQ(operations_on(print),
              (Operations{Operation::fill, Operation::draw, Operation::glue, Operation::label}));
    for (const SheetShape& shape : print.shapes) {
        if (shape.operation != Operation::glue) continue;
        EXPECT_EQ(shape.color, profile_table().front().pen(Operation::glue).color);
    }
}

// --- backs

// Turned pieces, and labels at all angles.
Layout turned_layout() {
    Layout layout = test::example_layout();
    layout.placements[1].angle = Angle::degrees(30);
    layout.placements[2].angle = Angle::degrees(-125);
    PatternPiece& house = layout.designs[0].pattern.pieces[1];
    for (int degrees = -360; degrees <= 360; degrees += 15) {
        // A little more than upright is upside down.
        for (const double more : {0.0, 0.02, -0.02})
            house.labels.push_back({LabelKind::tab,
                                    "text",
                                    {degrees / 20.0, 30},
                                    3.0,
                                    (degrees + more) * std::numbers::pi / 180.0});
    }
    return layout;
}

TEST(SheetViews, BacksAreFrontsMirroredAboutTheUprightAxis) {
    const Layout layout = turned_layout();
    for (const char* profile : {"workshop", "silhouette"}) {
        OutputOptions front = options_for(profile, false, ScoreSide::front, false);
        front.profile.machine_order = false;
        front.profile.marks = Marks::corners;
        OutputOptions back = front;
        back.backs = true;
        back.score_side = ScoreSide::back;
        for (int sheet = 0; sheet < 2; ++sheet) {
            const SheetDrawing a = draw_sheet(layout, front, view_of(sheet, false));
            const SheetDrawing b = draw_sheet(layout, back, view_of(sheet, true));
            EXPECT_EQ(b.title, a.title + ", back");
            ASSERT_EQ(a.shapes.size(), b.shapes.size());
            ASSERT_EQ(a.points.size(), b.points.size());
            for (std::size_t i = 0; i < a.shapes.size(); ++i) {
                EXPECT_EQ(a.shapes[i].operation, b.shapes[i].operation);
                EXPECT_EQ(a.shapes[i].color, b.shapes[i].color);
                const auto runs = a.runs_of(a.shapes[i]);
                ASSERT_EQ(runs.size(), b.runs_of(b.shapes[i]).size());
                for (std::size_t r = 0; r < runs.size(); ++r) {
                    const auto p = a.points_of(runs[r]);
                    const auto q = b.points_of(b.runs_of(b.shapes[i])[r]);
                    ASSERT_EQ(p.size(), q.size());
                    // Corners of halos go the other way round, and marks are for a machine (SheetMarks).
                    if (a.shapes[i].halo || a.shapes[i].operation == Operation::registration) continue;
                    for (std::size_t k = 0; k < p.size(); ++k) {
                        EXPECT_EQ(q[k].x, 297.0 - p[k].x);
                        EXPECT_EQ(q[k].y, p[k].y);
                    }
                }
            }
        }
    }
}

// Texts of fronts lie where the pattern has them, those of backs in the mirrored place, all to be read from
// below or from the right.
TEST(SheetViews, TextsAreReadable) {
    const Layout layout = turned_layout();
    for (const bool back : {false, true}) {
        OutputOptions options = options_for("workshop", back, ScoreSide::front, false);
        for (int sheet = 0; sheet < 2; ++sheet) {
            const SheetDrawing drawing = draw_sheet(layout, options, view_of(sheet, back));
            std::size_t next = 0;
            for (const Placement& placement : layout.placements) {
                if (placement.sheet != sheet) continue;
                const PatternPiece& piece =
                    layout.designs[0].pattern.pieces[static_cast<std::size_t>(placement.piece)];
                for (const Label& label : piece.labels) {
                    ASSERT_LT(next, drawing.texts.size());
                    const SheetText& text = drawing.texts[next++];
                    EXPECT_EQ(text.text, label.text);
                    EXPECT_EQ(text.cap_mm, label.height_mm);
                    const double angle = label.angle + placement.angle.deg * std::numbers::pi / 180.0;
                    Vec2 at = rotated(label.at, placement.angle.rad()) + placement.offset;
                    Vec2 along{std::cos(angle), std::sin(angle)};
                    if (back) {
                        at.x = drawing.width_mm - at.x;
                        along.x = -along.x;
                    }
                    EXPECT_NEAR(text.at.x, at.x, 1e-9);
                    EXPECT_NEAR(text.at.y, at.y, 1e-9);
                    // Along the same line, one way or the other.
                    EXPECT_NEAR(cross(along, Vec2{std::cos(text.angle), std::sin(text.angle)}), 0.0, 1e-9);
                    EXPECT_GT(text.angle, -0.5 * std::numbers::pi + 1e-10);
                    EXPECT_LE(text.angle, 0.5 * std::numbers::pi + 1e-8);
                }
            }
            EXPECT_EQ(next, drawing.texts.size());
        }
    }
}

// --- layers

// Whatever pens share a layer: all that is drawn is in the file.
TEST(SheetLayers, HaveEveryShapeInTheFile) {
    const Layout layout = test::example_layout();
    const auto pen = [](Profile& profile, Operation operation) -> Pen& {
        return profile.pens[static_cast<std::size_t>(operation)];
    };
    std::vector<Profile> profiles(profile_table().begin(), profile_table().end());
    for (const FoldStyle style : kFoldStyles) {
        for (const Profile& row : profile_table()) {
            profiles.push_back(row);
            profiles.back().folds = style;
            // Seams in the layer of cuts, in all but their dashes alike.
            profiles.push_back(profiles.back());
            Pen& seam = pen(profiles.back(), Operation::seam);
            seam = pen(profiles.back(), Operation::slit);
            profiles.push_back(profiles.back());
            pen(profiles.back(), Operation::mountain) = seam;
            pen(profiles.back(), Operation::valley) = seam;
        }
    }
    for (const Profile& profile : profiles) {
        OutputOptions options;
        options.profile = profile;
        Diagnostics diagnostics;
        const auto files = write_svg(layout, options, diagnostics).value();
        for (int sheet = 0; sheet < 2; ++sheet) {
            SCOPED_TRACE(profile.name + " " + std::string(to_string(profile.folds)) + " seam in " +
                         profile.pen(Operation::seam).layer);
            const SheetDrawing drawing = draw_sheet(layout, options, view_of(sheet, false));
            std::size_t in_layers = 0;
            for (const SheetLayer& layer : drawing.layers) {
                in_layers += layer.shapes;
                for (const SheetShape& shape : drawing.shapes_of(layer)) {
                    EXPECT_GE(shape.operation, layer.first);
                    EXPECT_LE(shape.operation, layer.last);
                }
            }
            EXPECT_EQ(in_layers, drawing.shapes.size());
            const std::string& svg = files[static_cast<std::size_t>(sheet)].bytes;
            std::size_t paths = 0;
            for (std::size_t at = svg.find("<path "); at != std::string::npos;
                 at = svg.find("<path ", at + 1))
                ++paths;
            const auto halos =
                static_cast<std::size_t>(std::count_if(drawing.shapes.begin(), drawing.shapes.end(),
                                                       [](const SheetShape& shape) { return shape.halo; }));
            EXPECT_EQ(paths, drawing.shapes.size() - halos);
        }
    }
}

}  // namespace
}  // namespace popup
