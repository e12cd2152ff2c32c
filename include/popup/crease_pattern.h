// The CreasePattern: a flat sheet as lines that are cut and folded, with nothing said about mechanisms.
//
// What is read from crease patterns (FOLD), and from drawings of cuts and folds. fold_sheet() lowers it to an
// assembly: the panels between the lines are plates, and how far each fold is folded at an opening follows
// from the angles that the pattern asks for and from its loops, which must stay closed.
//
//     CreasePattern pattern;
//     pattern.lines.push_back({{{0, 0}, {200, 0}, {200, 100}, {0, 100}}, true, CreaseUse::cut});
//     pattern.lines.push_back({{{100, 0}, {100, 100}}, false, CreaseUse::valley, 180.0});
//     const std::optional<Assembly> card = fold_sheet(pattern, {}, diagnostics);
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "popup/assembly.h"
#include "popup/curves.h"
#include "popup/diagnostics.h"
#include "popup/geometry.h"
#include "popup/units.h"

namespace popup {

enum class CreaseUse {
    cut,  // the border is one, too
    mountain,
    valley,
    fold,  // that does not say which way: it follows the others
    flat,  // is never folded: both its sides are one panel
};
inline constexpr std::array<std::string_view, 5> kCreaseUseNames{"cut", "mountain", "valley", "fold", "flat"};

struct CreaseLine {
    std::vector<Vec2> points;  // mm, at least two
    bool closed = false;
    CreaseUse use = CreaseUse::cut;
    // How far it is folded in the end, degrees in [0, 180]; none: as the pattern or the options say. A
    // mountain or valley of 0 is scored and lies flat in the end.
    std::optional<double> fold_deg = {};
    Place place = {};
    std::string name = {};  // by which options name it: "#ff0000", or the number of its edge
};

// Gives a line an angle as drawings say it, degrees in [-180, 180]: one less than 0 makes a mountain of a
// valley, and a valley of a mountain. Of a fold that does not say which way, less than 0 is a mountain, and
// all else stays as it is.
inline void fold_by(CreaseLine& line, double deg) {
    line.fold_deg = deg < 0.0 ? -deg : deg;
    if (deg < 0.0) line.use = line.use == CreaseUse::mountain ? CreaseUse::valley : CreaseUse::mountain;
}

// What a FOLD file says beside its pattern, for whoever writes that pattern as FOLD again. Values are JSON as
// they were written, but for white space outside of texts, so that no digit is lost. Elements are known by
// where they are, because mending a sheet splits, joins and leaves out edges; they are kept where columns, or
// orders of faces, speak of them.
struct CarriedKeys {
    struct Member {
        std::string key;
        std::string json;
    };
    struct Column {
        std::string key;
        std::vector<std::string> json;  // a value an element
    };
    std::vector<Member> members;  // of the file and of the frame, in their order
    std::vector<Column> vertices, edges, faces;
    std::vector<Vec2> corners;  // mm
    std::vector<std::array<int, 2>> edge_corners;
    std::vector<std::vector<int>> face_corners;
    std::vector<std::string> left_out;  // keys that would be wrong of other elements
    std::size_t other_frames = 0;       // of the file, beside the one that was read
};

struct CreasePattern {
    std::string file;
    std::string stem;
    std::vector<CreaseLine> lines;
    double fold_deg = 90.0;  // of mountains and valleys that do not say theirs; (0, 180]
    Ruler ruler = {};        // of the drawing or file
    CarriedKeys carried = {};
    CurveTable curves = {};  // that chords of lines stand for; sheets show them where nothing is moved
};

struct FoldOptions {
    // How far folds are folded in the end, [0°, 180°], whatever the pattern says: those of lines with that
    // name, or that are called "mountain" or "valley"; an empty name: of all. The last that fits counts.
    struct NamedAngle {
        std::string name;
        Angle angle;
    };
    std::vector<NamedAngle> fold_angles = {};
    double to = 1.0;  // the share of the final angles at which the motion ends; (0, 1]
    // Corners this near are one; > 0. None: 0.002 mm, or 2e-6 of the sheet's longer side if that is more.
    std::optional<double> merge_mm = {};
    // Ends that miss what they mean to meet by no more are moved there; >= 0.02. None: 0.5 mm, or 1/400 of
    // the sheet's longer side if that is more, for on large sheets lines are drawn more coarsely.
    std::optional<double> snap_mm = {};
    // Corners may move by this, or by a thousandth of the sheet if that is more, to close loops.
    double refine_mm = 0.2;
    bool flat = false;         // fold_sheet() gives the sheet as fold_flat() finds it to lie, standing still
    double closure_mm = 1e-7;  // loops of a folded sheet are closed to this; > 0
    // The caliper of the board, > 0: fold_sheet() folds the sheet that allow_for_board() gives, if it gives
    // one. Not of sheets that lie flat.
    std::optional<double> board_mm = {};
};

// Lowers a crease pattern to an assembly: a piece of each part that folds hold together, a plate of each of
// its panels, hinges, cuts and folds with their final angles, and joints. The largest panel of a piece stands
// still; the others hang on it by a tree of folds, breadth first.
//
// The sweep goes from 180°, where the sheet is flat, to 0°, where each fold has its final angle: at an
// opening of θ it has its share (1 - θ/180) of it, as far as the loops allow. A loop is what folds around an
// inner corner, or around a hole, make; going around it the turns must add up to nought. Folds of loops
// therefore leave the flat sheet along the mountains and valleys of the pattern, and then go straight towards
// their final angles, brought to closure all the way (src/folded/path.h). Loops are closed to
// FoldOptions::closure_mm at every opening, and not only at some.
//
// Told with their places: repairs `end-moved`, `fold-drawn-twice`; warnings `dangling-fold`, `no-border`,
// `falls-out`, `fold-other-way`, `fold-stays-flat`, `folding-undecided` (connected folds whose motion was not
// found within a number of steps; they stay flat, and collisions are not looked for); errors
// `document-too-large`, `no-sheet`. A pattern whose loops do not close is told of with `not-rigid`, with the
// worst loop and by how much it stays open. It is folded as far as it can be; where it does not leave the
// flat sheet, panels are divided into triangles along which they bend, by as little as brings the folds near
// to their angles, so that it can be seen (Sweep::bends). Where the written angles close, and no motion of
// rigid panels reaches them, the sheet jumps there at its end: `no-rigid-way`. Folds that end at other angles
// than they are to are counted in `other-angle`; remarks: `web-corners` tells of webs between the walls of a
// tray, `no-folds` of a sheet without any, `board-left-out` of a board that no allowance was made for. What
// is cut and scored stays as drawn. Cost: near linear in lines, and in panels times ranges of the motion.
std::optional<Assembly> fold_sheet(const CreasePattern& pattern, const FoldOptions& options,
                                   Diagnostics& diagnostics);

struct BoardedSheet {
    CreasePattern pattern;
    bool moved = false;  // then it says all angles of its folds, and names of FoldOptions must not; else it
                         // is as it was
};

// The sheet of a carton with its creases moved for board of that caliper, folded whole by the options. Where
// panels lie on each other in the closed shape, their middles are a caliper apart: the one that goes inside
// is moved in, by moving its crease, and all that is beyond it, into the panel that it hangs on. A tuck flap
// goes in by a caliper and a half. The panel that is inside already stays inside; of others the smaller goes
// inside. Cuts that go on from the ends of a crease move with it. Creases of loops stay where they are.
//
// Told: the warning `crease-moved` for each, with where it was and is; `no-room-for-board` of panels that lie
// too near after that; the remark `carton-size` for each piece: its blank, its area, its outer size and what
// it holds closed, which is the hull of its panels less half a caliper on all sides. nullopt: the pattern is
// no sheet that folds rigidly, and nothing is told. Cost: near linear in panels, times those that lie near
// one another, a few times over.
std::optional<BoardedSheet> allow_for_board(const CreasePattern& pattern, const FoldOptions& options,
                                            double board_mm, Diagnostics& diagnostics);

}  // namespace popup
