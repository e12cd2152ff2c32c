// A sheet of a Layout as a picture: what SVG and PDF (and any later sheet format) have in common.
//
// What is done with a thing, in which order, where it lies on the sheet, and what becomes of folds: each fact
// stands here once; how it looks is the profile's. Coordinates are those of the sheet: millimetres, origin at
// the lower left corner, y up.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "popup/layout.h"
#include "popup/profile.h"

namespace popup {

// Lengths in mm of dash, gap, dash, gap … for one line of `length_mm` in a dashed layer, fitted so that the
// line begins and ends with a whole dash; none for what is not a fold. Valley: even dashes; mountain: long
// and short dashes in turn; seam: short dashes. So they can be told apart without their colours, too.
struct Dashes {
    std::array<double, 4> mm{};
    std::size_t count = 0;
    [[nodiscard]] std::span<const double> pattern() const { return {mm.data(), count}; }
};
Dashes fitted_dashes(Operation fold, double length_mm);

// Points [first, first + count) of SheetDrawing::points.
struct Run {
    std::size_t first = 0;
    std::size_t count = 0;
    bool closed = false;
};

// Operations that share a layer of a profile: [first, last].
struct SheetLayer {
    std::string_view name;
    Operation first = Operation::fill;
    Operation last = Operation::fill;
};
// The layers of a profile, in the order of its operations.
std::vector<SheetLayer> layers_of(const Profile& profile);

// One path: a line, a contour, a line of perforations, or an area with its holes (even-odd).
struct SheetShape {
    Operation operation = Operation::outer_cut;
    std::size_t first_run = 0;
    std::size_t runs = 0;
    int plate = -1;         // index into SheetPiece::plate_names, -1: none
    Color color;            // of the line, or in `fill` of the area
    double width_mm = 0.0;  // of the line
};

struct SheetText {
    std::string text;     // valid UTF-8 without control characters, not empty
    Vec2 at;              // the middle of the text: half its length, half the height of its capitals
    double cap_mm = 0.0;  // height of the capitals
    double angle = 0.0;   // radians, counter-clockwise, in (-90°, 90°]: read from below or from the right
};

// One placed piece. Names are valid UTF-8 without control characters.
struct SheetPiece {
    std::string name;
    std::string design;  // the design's stem
    std::string prefix;  // goes before plate names; empty with a single input
    int copy = 0;        // from 0
    std::span<const std::string> plate_names;
    // Shapes of operation i: [first_shape[i], first_shape[i + 1]) of SheetDrawing::shapes.
    std::array<std::size_t, kOperations.size() + 1> first_shape{};
    std::size_t first_text = 0;
    std::size_t texts = 0;
};

struct SheetDrawing {
    double width_mm = 0.0;
    double height_mm = 0.0;
    std::string title;               // "castle" or "castle, sheet 2 of 3"
    std::vector<SheetPiece> pieces;  // in the order of the placements
    std::vector<SheetShape> shapes;
    std::vector<Run> runs;
    std::vector<Vec2> points;
    std::vector<SheetText> texts;

    [[nodiscard]] std::span<const SheetShape> shapes_of(const SheetPiece& piece, Operation first,
                                                        Operation last) const;
    [[nodiscard]] std::span<const Run> runs_of(const SheetShape& shape) const;
    [[nodiscard]] std::span<const Vec2> points_of(const Run& run) const;
    [[nodiscard]] std::span<const SheetText> texts_of(const SheetPiece& piece) const;
    // Of a shape's lines, for its dashes.
    [[nodiscard]] double length_of(const SheetShape& shape) const;
};

// Draws sheet `sheet` (from 0). Placements must be ordered by sheet, as lay_out() leaves them. The drawing
// refers to the layout's plate names and must not outlive it.
// Cost: linear in what lies on the sheet, and a search for its first placement.
SheetDrawing draw_sheet(const Layout& layout, const Profile& profile, int sheet);

// "castle", or "castle and 2 more" of several designs: for titles.
std::string layout_title(const Layout& layout);

// "popupc 0.1.0".
std::string_view generator();

// Height of DejaVu Sans' capitals as a part of its font size.
inline constexpr double kCapHeight = 1493.0 / 2048.0;

}  // namespace popup
