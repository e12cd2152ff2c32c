// Machine order of small layouts made by hand.
#include "output/machine_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "support/machine_lines.h"
#include "support/sheet_example.h"

namespace popup {
namespace {

using test::drawn;
using test::expect_order;
using test::expected_lines;
using test::lengths_of;
using test::Line;
using test::lines_of;
using test::machine_profiles;
using test::pen_of;
using test::rectangle;

constexpr double kTinyMm = 0.02;

// A machine that cuts and scores, every kind in a layer of its own.
Profile plain_machine() {
    Profile profile = *find_profile("lightburn");
    pen_of(profile, Operation::mountain) = {"mountain", {1, 2, 3}, 0.1};
    return profile;
}

PatternPiece piece_of(const std::string& name, std::vector<Contour> cuts) {
    PatternPiece piece;
    piece.name = name;
    piece.cuts = std::move(cuts);
    piece.silhouette = {{piece.cuts.back().points, {}}};
    piece.bounds = bounds(piece.cuts.back().points);
    return piece;
}

Layout layout_of(std::vector<PatternPiece> pieces, const std::vector<Vec2>& offsets) {
    Layout layout;
    layout.margin_mm = 5;
    layout.sheets = {{300, 300, 0.5, {200, 200}}};
    layout.designs = {{"hand.xml", "hand", {}}};
    layout.designs[0].pattern.pieces = std::move(pieces);
    for (std::size_t i = 0; i < offsets.size(); ++i) {
        Placement placement;
        placement.piece = static_cast<int>(i);
        placement.offset = offsets[i];
        layout.placements.push_back(placement);
    }
    return layout;
}

// A ring; in its hole a smaller ring with a slit; in the hole of that a square.
Layout nested_layout() {
    // Which way round a contour runs does not matter.
    Ring clockwise = rectangle(-30, -30, 30, 30);
    std::reverse(clockwise.begin(), clockwise.end());
    return layout_of({piece_of("ring", {{clockwise, true, 1}, {rectangle(-50, -50, 50, 50), true, 0}}),
                      piece_of("inner ring", {{{{-18, -14}, {-14, -18}}, false, 1},
                                              {rectangle(-10, -10, 10, 10), true, 1},
                                              {rectangle(-20, -20, 20, 20), true, 0}}),
                      piece_of("square", {{rectangle(-5, -5, 5, 5), true, 0}})},
                     {{100, 100}, {101, 99}, {102, 98}});
}

TEST(MachineOrder, CutsPiecesInHolesOfOthersBeforeTheHoles) {
    for (const Profile& profile : machine_profiles()) {
        SCOPED_TRACE(profile.name);
        const SheetDrawing drawing = drawn(nested_layout(), profile);
        const std::vector<Line> lines = lines_of(drawing);
        ASSERT_EQ(lines.size(), 6U);
        expect_order(lines);
        // What falls out of a hole is not the outermost of the sheet.
        std::vector<std::pair<double, int>> closed;  // length and depth, in their order
        for (const SheetShape& shape : drawing.shapes) {
            if (!drawing.runs_of(shape).front().closed) continue;
            closed.emplace_back(drawing.length_of(shape), shape.depth);
            EXPECT_EQ(shape.operation, shape.depth == 0 ? Operation::outer_cut : Operation::inner_cut);
            EXPECT_EQ(shape.color, profile.pen(shape.operation).color);
            EXPECT_EQ(shape.width_mm, profile.pen(shape.operation).width_mm);
        }
        // The tool for inner cuts cuts the outlines in holes, too: half of what it burns away more is on each
        // side of a square.
        const double more =
            4.0 * (profile.pen(Operation::inner_cut).kerf_mm - profile.pen(Operation::outer_cut).kerf_mm);
        const std::vector<std::pair<double, int>> expected{
            {40 + more, 4}, {80, 3}, {160 + more, 2}, {240, 1}, {400, 0}};
        ASSERT_EQ(closed.size(), expected.size());
        for (std::size_t i = 0; i < closed.size(); ++i) {
            EXPECT_NEAR(closed[i].first, expected[i].first, more == 0.0 ? 0.0 : 1e-5);
            EXPECT_EQ(closed[i].second, expected[i].second);
        }
    }
}

TEST(MachineOrder, KeepsOuterCutsWhereInnerOnesAreLeftOut) {
    Profile profile = plain_machine();
    pen_of(profile, Operation::inner_cut).layer.clear();
    for (const Line& line : lines_of(drawn(nested_layout(), profile)))
        EXPECT_EQ(line.operation, Operation::outer_cut);
}

TEST(MachineOrder, TellsAHoleFromPaperThatOnlyReachesRoundAPiece) {
    // A hook round a square: its box holds the square, its paper and its hole do not.
    const Ring hook{{0, 0}, {60, 0}, {60, 60}, {50, 60}, {50, 10}, {0, 10}};
    const Layout layout = layout_of(
        {piece_of("hook", {{{{52, 2}, {58, 2}, {58, 58}, {56, 58}, {56, 4}, {2, 4}, {2, 2}}, true, 1},
                           {hook, true, 0}}),
         piece_of("square", {{rectangle(0, 0, 10, 10), true, 0}})},
        {{10, 10}, {30, 30}});
    const SheetDrawing drawing = drawn(layout, plain_machine());
    int outer = 0;
    for (const SheetShape& shape : drawing.shapes) outer += shape.operation == Operation::outer_cut ? 1 : 0;
    EXPECT_EQ(outer, 2);
}

// Every other pair touches: a row of three, and one above that touches two of them in part.
TEST(MachineOrder, CutsWhatPiecesLaidEdgeToEdgeShareOnce) {
    for (const double gap : {0.0, 0.005}) {
        for (const double turn : {0.0, 90.0, 33.0}) {
            Layout layout = layout_of({piece_of("square", {{rectangle(0, 0, 20, 20), true, 0}}),
                                       piece_of("square", {{rectangle(0, 0, 20, 20), true, 0}}),
                                       piece_of("square", {{rectangle(0, 0, 20, 20), true, 0}}),
                                       piece_of("square", {{rectangle(0, 0, 20, 20), true, 0}})},
                                      {{0, 0}, {20 + gap, 0}, {40 + 2 * gap, 0}, {10, 20 + gap}});
            for (Placement& placement : layout.placements) {
                placement.angle = Angle::degrees(turn);
                placement.offset = rotated(placement.offset, placement.angle.rad()) + Vec2{100, 100};
            }
            const std::vector<Line> expected = expected_lines(layout, plain_machine(), 0);
            const std::vector<Line> found = lines_of(drawn(layout, plain_machine()));
            EXPECT_NEAR(lengths_of(expected).at(Operation::outer_cut), 320.0, 1e-9);
            EXPECT_NEAR(lengths_of(found).at(Operation::outer_cut), 320.0 - 3 * 20.0, 4 * gap + 1e-6);
            for (const Line& line : expected) {
                for (const Segment& one : line.segments()) {
                    for (int i = 0; i <= 40; ++i) {
                        double least = HUGE_VAL;
                        for (const Line& other : found) {
                            for (const Segment& drawn_one : other.segments())
                                least = std::min(least, distance(lerp(one.a, one.b, i / 40.0), drawn_one));
                        }
                        EXPECT_LE(least, 0.01);
                    }
                }
            }
        }
    }
}

TEST(MachineOrder, OutlinesInHolesKeepTheirSizeWhicheverToolBurnsMore) {
    Profile profile = plain_machine();
    for (const auto& [inner, outer] : {std::pair(0.6, 0.2), std::pair(0.1, 0.5)}) {
        profile.pens[static_cast<std::size_t>(Operation::inner_cut)].kerf_mm = inner;
        profile.pens[static_cast<std::size_t>(Operation::outer_cut)].kerf_mm = outer;
        const SheetDrawing drawing = drawn(nested_layout(), profile);
        for (const SheetShape& shape : drawing.shapes) {
            if (shape.depth != 4) continue;
            Box box;
            for (const Vec2 p : drawing.points_of(drawing.runs_of(shape).front())) box.extend(p);
            // 10 mm where the kerf of outer cuts is there already.
            EXPECT_NEAR(box.max.x - box.min.x, 10.0 + inner - outer, 1e-5);
            EXPECT_NEAR(box.max.y - box.min.y, 10.0 + inner - outer, 1e-5);
        }
    }
}

TEST(MachineOrder, LeavesAFoldThatLiesOnACut) {
    Layout layout = layout_of({piece_of("square", {{rectangle(0, 0, 20, 20), true, 0}})}, {{50, 50}});
    layout.designs[0].pattern.pieces[0].lines = {{LineKind::valley, {{0, 0}, {20, 0}}}};
    const auto lengths = lengths_of(lines_of(drawn(layout, plain_machine())));
    EXPECT_NEAR(lengths.at(Operation::valley), 20.0, 1e-9);
    EXPECT_NEAR(lengths.at(Operation::outer_cut), 80.0, 1e-9);
}

TEST(MachineOrder, HasNoTinySegmentsAndMovesNothingFar) {
    // A disc in steps of 0.003 to 0.03 mm, and an open wave likewise.
    Ring disc;
    double angle = 0.0;
    while (angle < 6.28) {
        disc.push_back({15.0 * std::cos(angle), 15.0 * std::sin(angle)});
        angle += 0.001 + 0.0009 * std::sin(40 * angle);
    }
    disc.push_back({15.0 * std::cos(-0.0007), 15.0 * std::sin(-0.0007)});  // a hair from where it begins
    std::vector<Vec2> wave;
    for (int i = 0; i <= 1003; ++i) wave.push_back({-8.0 + 0.015 * i, std::sin(0.01 * i)});
    const Ring dot{{0, 5}, {0.008, 5}, {0.008, 5.008}, {0, 5.008}};
    const Layout layout =
        layout_of({piece_of("disc", {{wave, false, 1}, {dot, true, 1}, {disc, true, 0}})}, {{50, 50}});
    const std::vector<Line> expected = expected_lines(layout, plain_machine(), 0);
    const std::vector<Line> found = lines_of(drawn(layout, plain_machine()));
    ASSERT_EQ(found.size(), expected.size());
    std::size_t segments = 0;
    for (const Line& line : found) {
        const bool is_dot = line.length() < 0.1;
        // So small a hole is drawn as it is.
        if (is_dot) {
            EXPECT_EQ(line.points.size(), 4U);
            continue;
        }
        for (const Segment& one : line.segments()) {
            ++segments;
            EXPECT_GE(distance(one.a, one.b), kTinyMm);
        }
    }
    EXPECT_LT(segments, 5600U);
    EXPECT_GT(segments, 4000U);
    for (const Line& line : expected) {
        for (const Vec2 p : line.points) {
            double least = HUGE_VAL;
            for (const Line& other : found) {
                if (other.closed != line.closed) continue;
                for (const Segment& one : other.segments()) least = std::min(least, distance(p, one));
            }
            EXPECT_LE(least, kTinyMm);
        }
    }
    // Ends of open lines stay.
    for (const Line& line : found) {
        if (line.closed) continue;
        std::vector<Vec2> ends{line.points.front(), line.points.back()};
        if (ends[0].x > ends[1].x) std::swap(ends[0], ends[1]);
        EXPECT_LE(distance(ends[0], wave.front() + Vec2{50, 50}), 1e-9);
        EXPECT_LE(distance(ends[1], wave.back() + Vec2{50, 50}), 1e-9);
    }
}

// Two parts of one piece in the same hole are no deeper than one would be.
TEST(MachineOrder, CountsTheHoleRoundAPieceOfSeveralPartsOnce) {
    const Layout layout = layout_of(
        {piece_of("ring", {{rectangle(-30, -30, 30, 30), true, 1}, {rectangle(-50, -50, 50, 50), true, 0}}),
         piece_of("pair", {{rectangle(-20, -20, -5, 20), true, 0}, {rectangle(5, -20, 20, 20), true, 0}})},
        {{100, 100}, {100, 100}});
    const SheetDrawing drawing = drawn(layout, plain_machine());
    for (const SheetShape& shape : drawing.shapes) {
        if (shape.piece != 1) continue;
        EXPECT_EQ(shape.depth, 2);
    }
}

TEST(MachineOrder, LeavesWhatIsPrintedAsItIs) {
    Profile profile = *find_profile("silhouette");
    const Layout layout = test::example_layout();
    const SheetDrawing ordered = drawn(layout, profile);
    profile.machine_order = false;
    const SheetDrawing plain = drawn(layout, profile);
    const auto printed = [](const SheetDrawing& drawing) {
        std::vector<std::vector<Vec2>> all;
        for (const SheetShape& shape : drawing.shapes) {
            if (!is_printed(shape.operation)) continue;
            for (const popup::Run& run : drawing.runs_of(shape)) {
                const auto points = drawing.points_of(run);
                all.emplace_back(points.begin(), points.end());
            }
        }
        return all;
    };
    EXPECT_GE(printed(plain).size(), 5U);
    EXPECT_EQ(printed(ordered), printed(plain));
    EXPECT_EQ(ordered.texts.size(), plain.texts.size());
}

}  // namespace
}  // namespace popup
