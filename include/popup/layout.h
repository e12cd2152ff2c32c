// The Layout: every piece of every design placed on sheets.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "popup/pattern.h"
#include "popup/units.h"

namespace popup {

// A named paper, portrait.
struct Paper {
    std::string_view name;
    double width_mm;
    double height_mm;
};
std::vector<Paper> const& paper_table();  // letter, a4, tabloid, a3, a2, a1, a0: the order `auto` tries them

// What pieces are put on. `name` "auto" picks the first paper that takes the largest piece; another name of
// the table takes that paper, turned as the largest piece needs (landscape if either way serves); empty:
// width × height as given.
struct SheetChoice {
    std::string name = "auto";
    double width_mm = 0.0;
    double height_mm = 0.0;
};
// Parses "auto", a paper's name, or WxH with an optional unit (mm, in); nullopt when it is none of these or
// not positive and finite.
std::optional<SheetChoice> parse_sheet(std::string_view text);

// Which turns a piece may be given on the sheet: steps of 360°/count; 0: any angle.
struct Rotation {
    int count = 4;
};
// Parses none, 180, 90, any, or a count N ≥ 1.
std::optional<Rotation> parse_rotation(std::string_view text);

struct LayoutOptions {
    SheetChoice sheet;
    Length margin = Length::millimetres(5.0);   // free edge of the sheet, ≥ 0
    Length spacing = Length::millimetres(2.0);  // between pieces, ≥ 0
    Rotation rotation;
    double scale = 1.0;  // of all pieces, > 0
    int copies = 1;      // of all inputs, ≥ 1
};

// One design's share of a production run.
struct DesignPattern {
    std::string file;
    std::string stem;  // made unique: "castle", "castle~2"
    Pattern pattern;   // lay_out() applies the scale
};

// p ↦ turn p about the origin by `angle`, then move by `offset`. Sheet coordinates: origin at the lower left
// corner, x right, y up, millimetres.
struct Placement {
    int design = 0;
    int piece = 0;
    int copy = 0;  // from 0
    int sheet = 0;
    Vec2 offset;
    Angle angle;

    [[nodiscard]] Vec2 apply(Vec2 p) const;
};

struct Layout {
    double width_mm = 0.0;
    double height_mm = 0.0;
    double margin_mm = 0.0;
    int sheets = 0;
    std::vector<DesignPattern> designs;
    std::vector<Placement> placements;  // by sheet, then design, copy and piece
    std::vector<double> utilisation;    // a sheet: area of paper in pieces / usable area
    std::vector<Vec2> used_mm;          // a sheet: width and height really used, margin not counted
    bool prefix_names = false;          // several inputs: names carry "STEM:"

    // The piece's name as outputs give it.
    [[nodiscard]] std::string piece_name(const Placement& placement) const;
};

// Places all copies of all pieces; each inside the margin, no two closer than the spacing (their boxes, for
// now). Errors: `piece-too-large` names piece, size and usable sheet. Cost: near linear in pieces, as a sheet
// holds a bounded number of them.
std::optional<Layout> lay_out(std::vector<DesignPattern> designs, const LayoutOptions& options,
                              Diagnostics& diagnostics);

}  // namespace popup
