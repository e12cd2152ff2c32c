// The Layout: every piece of every design placed on sheets.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "popup/nest.h"
#include "popup/pattern.h"
#include "popup/units.h"

namespace popup {

// A named paper, portrait.
struct Paper {
    std::string_view name;
    double width_mm;
    double height_mm;
    bool automatic = true;  // `auto` tries it
    bool american = false;
};
// a6, a5, letter, a4, legal, tabloid, a3, a2, a1, a0. `auto` tries those that are automatic, in this order.
std::vector<Paper> const& paper_table();

// Which papers `auto` tries.
enum class PaperFamily {
    automatic,  // of a run: by the units of its first design; of lay_out(), and where that is unknown: any
    iso,        // a4, a3, a2, a1, a0
    us,         // letter, tabloid; then, for what is larger, a2, a1, a0
    any         // all that are automatic
};
std::vector<Paper> papers_of(PaperFamily family);
// Those that are at hand where somebody measures so; any, where it is not known how.
PaperFamily papers_for(UnitSystem units);

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
// Parses none, any, or one of two numbers of degrees, 180 and 90; any other number N ≥ 1 is a count of turns.
std::optional<Rotation> parse_rotation(std::string_view text);

// Sheets of one size, and how many there are.
struct StockRow {
    SheetChoice size;
    int count = -1;  // -1: as many as wanted
};
// Parses "SIZE[:COUNT],SIZE[:COUNT]…", sizes as parse_sheet() has them but not "auto"; nullopt when it is not
// that.
std::optional<std::vector<StockRow>> parse_stock(std::string_view text);

// Paper has a grain, along which it folds and bends better.
enum class Grain {
    none,    // pieces turn as they may
    keep,    // no piece turns
    either,  // pieces turn by 0° or 180°, identical pieces all alike
};

// A place on a sheet that a piece keeps: what a report says of a placement.
struct PieceLock {
    int sheet = 0;
    Vec2 offset;  // mm, from the corner of the sheet, margin included
    Angle angle;
};

// What holds for the pieces of one name, as outputs give it ("page", "castle:page"); "page" is every
// design's.
struct PieceRule {
    std::string piece;
    int copy = 0;                      // of a lock: which copy of the piece, from 0
    std::optional<Rotation> rotation;  // instead of the run's
    std::optional<PieceLock> lock;
};

struct LayoutOptions {
    SheetChoice sheet;
    PaperFamily papers = PaperFamily::automatic;
    std::vector<StockRow> stock;                // if not empty, instead of `sheet`
    Vec2 bed;                                   // of the machine: no sheet may be larger; 0 × 0: any may
    Length margin = Length::millimetres(5.0);   // free edge of the sheet, ≥ 0
    Length spacing = Length::millimetres(2.0);  // between pieces, 0 to 100 m; else the nearer end
    Rotation rotation;
    Grain grain = Grain::none;   // if not none, instead of all rotations
    bool part_in_hole = true;    // whether pieces may lie in the holes of others
    bool group_designs = false;  // whether all pieces of one copy of a design share a sheet
    std::vector<PieceRule> rules;
    double scale = 1.0;  // of all pieces, > 0
    int copies = 1;      // of all inputs, ≥ 1
    // As long as popupc looks where nobody says how long.
    NestEffort nesting{.shortening = kQuickShortening};
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

struct LayoutSheet {
    double width_mm = 0.0;
    double height_mm = 0.0;
    double utilisation = 0.0;  // area of paper in pieces / usable area
    Vec2 used_mm;              // width and height really used, margin not counted
};

struct Layout {
    double margin_mm = 0.0;
    std::vector<LayoutSheet> sheets;
    std::vector<DesignPattern> designs;
    std::vector<Placement> placements;  // by sheet, then design, copy and piece
    Box leftover;  // on the last sheet, the largest free rectangle, in sheet coordinates; clear of the margin
                   // and of the spacing round pieces
    bool prefix_names = false;  // several inputs: names carry "STEM:"

    // The piece's name as outputs give it.
    [[nodiscard]] std::string piece_name(const Placement& placement) const;
};

// Places all copies of all pieces by their outlines; each inside the margin, no two closer than the spacing,
// as nest() promises. Errors name piece, size and usable sheet (`piece-too-large`), or what else stands in
// the way: `sheet-too-small`, `sheet-too-large` for the bed, `too-many-pieces`, `unknown-piece`,
// `lock-impossible`, `stock-used-up`, `group-too-large`. A single piece has no label with its name. Of
// no pieces there is a layout without sheets. Precondition: silhouettes have an area.
std::optional<Layout> lay_out(std::vector<DesignPattern> designs, const LayoutOptions& options,
                              Diagnostics& diagnostics);

}  // namespace popup
