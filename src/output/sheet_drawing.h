// A sheet of a Layout as a picture: what all sheet formats have in common.
//
// What is done with a thing, in which order, on which side, where it lies on the sheet, and what becomes of
// folds: each fact stands here once; how it looks is the profile's. Coordinates are those of the sheet:
// millimetres, origin at the lower left corner, y up.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/cap_height.h"
#include "popup/layout.h"
#include "popup/output.h"
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

// Points [first, first + count) of SheetDrawing::points. Where curves are known, the same again as steps
// [first_step, first_step + steps) of SheetDrawing::steps, from point `start` of its own on.
struct Run {
    std::size_t first = 0;
    std::size_t count = 0;
    bool closed = false;
    std::size_t start = 0;
    std::size_t first_step = 0;
    std::size_t steps = 0;  // 0: all is straight
};

// One path: a line, a contour, a line of perforations, or an area with its holes (even-odd).
struct SheetShape {
    Operation operation = Operation::outer_cut;
    std::size_t first_run = 0;
    std::size_t runs = 0;
    int piece = -1;                         // index into SheetDrawing::pieces, -1: the sheet's own
    int plate = -1;                         // index into SheetPiece::plate_names, -1: none
    std::optional<double> fold_angle = {};  // of a fold, radians; where that is known
    int depth = 0;                          // of a cut: in how many contours of the sheet it lies
    bool outline = false;                   // the cut round a piece, or a part of it
    bool filled = false;                    // an area in its colour, or with its picture, without a line
    bool halo = false;                      // an area below what could not be seen otherwise (output/halos.h)
    int image = -1;         // of an area: index into SheetDrawing::images, -1: it has a colour
    Color color;            // of the line, or of the area
    double width_mm = 0.0;  // of the line
};

// A picture on the sheet; the shape that names it says what of it is to be seen.
struct SheetImage {
    const Image* image = nullptr;
    Affine place;  // from its pixels to the sheet
};

struct SheetText {
    std::string text;     // valid UTF-8 without control characters, not empty
    Vec2 at;              // the middle of the text: half its length, half the height of its capitals
    double cap_mm = 0.0;  // height of the capitals
    double angle = 0.0;  // radians, counter-clockwise; of labels in (-90°, 90°]: read from below or from the
                         // right
    Operation operation = Operation::label;
    int piece = -1;  // as of shapes
    Color color;
    TextFont font = TextFont::sans;
};

// One placed piece. Names are valid UTF-8 without control characters.
struct SheetPiece {
    std::string name;
    std::string design;  // the design's stem
    std::string prefix;  // goes before plate names; empty with a single input
    int copy = 0;        // from 0
    std::span<const std::string> plate_names;
};

// Operations [first, last] that share a layer of the profile, and what they draw.
struct SheetLayer {
    std::string name;
    Operation first = Operation::fill;
    Operation last = Operation::fill;
    std::size_t first_shape = 0;  // shapes [first_shape, first_shape + shapes) of the drawing
    std::size_t shapes = 0;
    std::size_t first_text = 0;
    std::size_t texts = 0;
};

struct SheetDrawing {
    Profile profile;  // by which it is drawn
    double width_mm = 0.0;
    double height_mm = 0.0;
    std::string title;               // "castle" or "castle, sheet 2 of 3"
    std::vector<SheetPiece> pieces;  // in the order of the placements
    std::vector<SheetLayer> layers;  // of the profile, in the order of its operations, empty ones too
    std::vector<SheetShape> shapes;  // in the order in which they are drawn: layer by layer
    std::vector<SheetText> texts;    // likewise
    std::vector<SheetImage> images;
    std::vector<Run> runs;
    std::vector<Vec2> points;
    std::vector<PathStep> steps;
    std::size_t joints = 0;         // in outer cuts, and in cuts of holes with a piece inside
    std::vector<int> loose_pieces;  // that have under two of them, or whose hole has; indices into `pieces`

    [[nodiscard]] std::span<const SheetShape> shapes_of(const SheetLayer& layer) const;
    [[nodiscard]] std::span<const SheetText> texts_of(const SheetLayer& layer) const;
    [[nodiscard]] std::span<const Run> runs_of(const SheetShape& shape) const;
    [[nodiscard]] std::span<const Vec2> points_of(const Run& run) const;
    // The run with its curves, for writers that have them; else its points. A closed one has no step for a
    // line that ends at its start.
    [[nodiscard]] Subpath path_of(const Run& run) const;
    // Of a shape's lines, for its dashes.
    [[nodiscard]] double length_of(const SheetShape& shape) const;
};

// One picture of a sheet: a side of it, and what of that is in this file.
struct SheetView {
    enum class Part { whole, print, cut };
    int sheet = 0;  // from 0
    bool back = false;
    Part part = Part::whole;
    std::string part_suffix;  // "", "-print", "-cut"
    std::string suffix;       // of a file that holds this view alone: "-2-back-cut", of the first sheet ""
    // Whether anything of the layout is folded or glued, which a legend asks; none: it is looked for anew.
    std::optional<bool> folded_or_glued = {};
};

// The pictures that the options ask for: of each sheet its front, then its back; all prints before all cuts.
// A side on which no sheet of the layout has anything is left out: names do not depend on what lies where.
// Errors: `reference-too-long`, for a bar that a sheet has no room for; `font-missing`, when letters are to
// be outlines and there is no font. Cost: linear in placements.
std::optional<std::vector<SheetView>> views_of(const Layout& layout, const OutputOptions& options,
                                               Diagnostics& diagnostics);
// The views part by part, for formats that hold all of a part in one file.
std::vector<std::span<const SheetView>> parts_of(std::span<const SheetView> views);

// Draws a view. A back is drawn as it is seen when the sheet is turned over about its upright axis. Where the
// profile wants machine order, cuts stand by their depth on the sheet (a piece in another's hole comes before
// the hole), lines that pieces share are drawn once, points closer to each other than 0.02 mm are one, and
// within a kind of line the way between lines is short (fabrication/tour.h), from the lower left corner on;
// else all stands piece by piece. Curves that chords stand for are drawn last, and change no point.
// Placements must be ordered by sheet, as lay_out() leaves them. The drawing refers to the layout and the
// options and must not outlive them. Cost: near linear in what lies on the sheet.
SheetDrawing draw_sheet(const Layout& layout, const OutputOptions& options, const SheetView& view);

// A file for each view that the options ask for, of the bytes that `write` makes of its drawing; where it
// makes none, no files. The views are drawn one by one, in their order. Errors: those of views_of() and of
// `write`.
using ViewWriter = std::function<std::optional<std::string>(const SheetDrawing&, const SheetView&)>;
std::optional<std::vector<SheetFile>> file_per_view(const Layout& layout, const OutputOptions& options,
                                                    Diagnostics& diagnostics, const ViewWriter& write);

// "castle", or "castle and 2 more" of several designs: for titles.
std::string layout_title(const Layout& layout);

// "popupc 0.1.0".
std::string_view generator();

}  // namespace popup
