// The Assembly: rigid plates, the lines on them, and how each plate's frame follows from others.
//
// The narrow waist. Nothing here or after it knows what a v-fold is, nor in which language anything was
// written: designs of cards are lowered to it, drawings and programs of flat parts are read to it. A flat
// part is a piece whose plates nothing moves, so an assembly of parts has no joints.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "popup/curves.h"
#include "popup/diagnostics.h"
#include "popup/geometry.h"
#include "popup/joints.h"
#include "popup/lines.h"
#include "popup/print.h"

namespace popup {

class CheckedDesign;

// A rigid panel, in the coordinates of its pattern page.
struct Plate {
    std::string name;  // "page/left", "bird/right"; unique
    int piece = 0;     // index into Assembly::pieces
    Polygon outline;   // what is left of it once all cut-outs are made
    Ring uncut = {};   // its outer ring before any cut-out; means nothing where nothing moves
    // The colour in which all of it is printed, under its prints; none: bare paper. No Area, for it is as
    // large as the plate whatever is cut out of it.
    std::optional<Color> fill = {};
    std::vector<Print> prints = {};  // what is printed on it, and lies on the outline; images are cut to it
    int parent = -1;                 // plate it is hinged to; -1: stands in the world
    Vec2 pivot = {};                 // a point of the hinge line, in this plate's page coordinates
    Lying lying = Lying::free;       // whether it is glued flat on its parent, and on which side
    // The point of its page about which it is turned by hand: it is looked at for collisions at all turns.
    std::optional<Vec2> rivet = {};
    // Where it stands, when no joint moves it and that is known: then it is shown in models.
    std::optional<Frame> stands = {};
};

// What is cut out as one.
//
// The plates of a piece share its paper out. Where a source says itself how the paper is cut, as drawings and
// programs of parts do, it is `paper`; else it is what the plates have together, cut along the lines of kind
// cut of the assembly.
struct Piece {
    std::string name;  // "page", or the element's id; unique, not empty
    std::vector<int> plates = {};
    Place place = {};  // in the source, of pieces that have a place of their own there
    // What is left when everything is cut, as base/regions.h has it: regions that do not overlap. Every edge
    // is a cut. A region that lies in a hole of another comes out loose; it belongs to the piece all the
    // same. Tabs are part of it, and seams the folds of its tabs: such a piece has no Glue.
    std::vector<Polygon> paper = {};
    std::vector<std::vector<Vec2>> slits = {};  // of `paper`: cuts besides, open, each of at least two points
    // What is printed on it, wherever its plates are; over what is printed on these. A piece with texts that
    // have no colour of their own is not labelled with its name.
    std::vector<Print> prints = {};
};

// A line on a piece. Folds and cuts between two plates name both; a line on an edge names one.
struct Line {
    LineKind kind = LineKind::cut;
    Segment at;
    int piece = 0;
    int plate = -1;  // -1: not known
    int other_plate = -1;
    // Of a fold: how far it is folded in the finished piece, [0, pi]; where that is known and does not
    // change.
    std::optional<double> fold_angle = {};
};

// Two plates joined along a line: a fold (one page) or a seam (two pages). `a_line` and `b_line` are the same
// points of paper, end for end, on each plate's page.
struct Hinge {
    int a = 0, b = 0;
    Segment a_line, b_line;
    bool glued = false;
};

// A glued seam with its tab. On the piece's page the tab lies on the left of `on_piece`, looking from a to b;
// on the base it covers the right of `on_base`.
struct Glue {
    int piece_plate = 0, base_plate = 0;
    Segment on_piece, on_base;
    std::string label;          // "1L": the same on the tab and on its target
    std::optional<Color> fill;  // of the tab
    std::string element;
    Place place;  // of the element, for findings about the tab
    // It lies on the base's back, with its front against it: then it covers the left of `on_base`, as seen
    // from the base's front, and nobody sees a target.
    bool on_back = false;
};

// A piece that is glued flat on a plate of another, over an area and not by tabs.
struct GluedArea {
    int plate = 0, base_plate = 0;
    std::vector<Polygon> on_base;  // page coordinates of the base plate; at least one, none of them overlap
    std::string label;             // "3": on the target, and before the piece's name
    std::string element;
    Place place;  // of the element
};

// Two plates that lie flat on each other where they stand: `plate` lies on the front of `base`, or on its
// back.
struct PlateOrder {
    int plate = 0, base = 0;
    bool on_front = true;
};

// The openings that a motion goes through, and how it begins.
struct Sweep {
    double from_deg = 0.0;  // 0: closed
    double to_deg = 180.0;  // > from_deg
    // At from_deg all plates lie in one plane, that of the first cover, and come from there as linkages do
    // that fold flat: distances shrink with the angle.
    bool closed_flat = true;
    // The plates only approximate the paper: it bends, or how it folds was not found. They are shown, and
    // not examined for collisions.
    bool bends = false;
};

// Lines in space, drawn by a program to make pieces that stand still: shown in models, never cut.
struct Trace {
    std::string name;                      // of its piece; else of its own, unlike those of pieces
    int piece = -1;                        // the piece that they were drawn for; -1: none
    std::vector<std::vector<Vec3>> lines;  // mm; each has at least two points
};

// What its author measures with; which papers are at hand follows from it (LayoutOptions::papers).
enum class UnitSystem { unknown, metric, inches };

// How models are to stand: with the spine upright, as a greeting card on a shelf; flat on a table, the open
// card facing up; or as a stage, the right page on the ground and the left one its back wall.
enum class Orientation {
    guessed,  // as scene writers see fit: nobody says
    upright,
    flat,
    stage
};

struct Assembly {
    std::string file;
    std::string stem;
    UnitSystem units = UnitSystem::unknown;  // of documents, by their unit
    Orientation orientation = Orientation::guessed;
    std::vector<Piece> pieces;
    std::vector<Plate> plates;
    std::vector<Line> lines;
    std::vector<Hinge> hinges;
    std::vector<Glue> glue;
    std::vector<GluedArea> glued_areas;
    std::vector<Joint> joints;  // in an order in which each finds its plates placed; none: nothing moves
    Sweep sweep;
    // The plates that are the card: nothing may stick out of them when it is closed. Left to right, those on
    // the left first; empty: nothing covers it.
    std::vector<int> covers;
    // Of plates that stand still, in any order: which lies on which, where that is known; a pair at most
    // once.
    std::vector<PlateOrder> layers;
    std::vector<Trace> traces;  // at most one a piece, in the order of the pieces, then those of none
    CurveTable curves = {};     // that chords of all pieces stand for
};

// Whether any of it moves. What does not has no motion, and stands in models as its plates do.
inline bool moves(const Assembly& assembly) { return !assembly.joints.empty(); }
// Whether models can show it: it moves, or it is known where some of it stands.
inline bool has_model(const Assembly& assembly) {
    if (moves(assembly) || !assembly.traces.empty()) return true;
    for (const Plate& plate : assembly.plates) {
        if (plate.stands) return true;
    }
    return false;
}

// Which joint-placed plates hang on which, as the joints say: sets parent, pivot and lying of each plate that
// the joint places. Whoever adds joints to an assembly calls it for each.
//
//     assembly.joints.push_back({"flap", {}, Drive{flap, {0, -40}, {0, 1}, 1}});
//     hang_plates(assembly.joints.back(), assembly.plates);
void hang_plates(const Joint& joint, std::vector<Plate>& plates);

struct AssembleOptions {
    // All pictures are to be levelled; height of the horizon of those that do not say it, in mm.
    std::optional<double> horizon_mm = {};
};

// Makes the plates' final outlines (cut-outs taken away, all at once a plate), cuts fills and drawn lines to
// the plates they lie on, gives areas and pictures to the plates they lie on and texts to their piece, and
// drops what a later cut took away from a fold. Guarantees: every plate has an
// outline with an area; every hinge's plates share its line; joints are in order. Cost: near linear in plates
// and lines. Its numbers are those of its text: settle_numbers() would change none of them.
std::optional<Assembly> assemble(const CheckedDesign& design, const AssembleOptions& options,
                                 Diagnostics& diagnostics);

}  // namespace popup
