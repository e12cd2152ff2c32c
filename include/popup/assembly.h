// The Assembly: rigid plates, the lines on them, and how each plate's frame follows from others.
//
// The narrow waist. Nothing here or after it knows what a v-fold is.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "popup/curves.h"
#include "popup/design.h"
#include "popup/geometry.h"
#include "popup/lines.h"

namespace popup {

class CheckedDesign;

// A rigid panel, in the coordinates of its pattern page.
struct Plate {
    std::string name;             // "page/left", "bird/right"
    int piece = 0;                // index into Assembly::pieces
    Polygon outline;              // what is left of it once all cut-outs are made
    Ring uncut;                   // its outer ring before any cut-out
    std::optional<Color> fill;    // none: bare paper
    std::vector<Stroke> strokes;  // clipped to the plate
    int parent = -1;              // plate it is hinged to; -1: stands in the world
    Vec2 pivot;                   // a point of the hinge line, in this plate's page coordinates
};

// What is cut out as one.
struct Piece {
    std::string name;  // "page", or the element's id
    std::vector<int> plates;
};

// A line on a piece. Folds and cuts between two plates name both; a line on an edge names one.
struct Line {
    LineKind kind = LineKind::cut;
    Segment at;
    int piece = 0;
    int plate = -1;
    int other_plate = -1;
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
};

// Closed set: how frames follow.
enum class JointKind {
    drive,      // turns with the opening angle about a line of the world
    half_turn,  // four-bar whose far sides equal the opposite near ones; the centre is the half turn of the
                // fold
    inside,     // four-bar that closes inside the fold (closed dihedral 0°)
    outside,    // four-bar that closes beyond the fold (closed dihedral 360°)
};

// One side of a four-bar linkage: a driving plate, and the element plate hinged to it along the seam.
// Angled: directions are seen from the apex. Parallel: across the fold.
struct Bar {
    int drive = -1;   // driving plate
    int plate = -1;   // plate this joint places
    Vec2 fold_at;     // on the driving plate's page: the apex (angled), any point of the fold (parallel)
    Vec2 fold_dir;    // unit, along the parent fold, into the V
    Vec2 fold_out;    // unit, perpendicular to fold_dir, from the fold into the driving plate
    Vec2 seam_at;     // a point of the seam or side fold on the driving plate's page (angled: the apex)
    Vec2 seam_dir;    // unit, on the driving plate's page: along the seam, away from the apex (parallel:
                      // fold_dir)
    Vec2 own_at;      // the same point on the element plate's own page
    Vec2 own_seam;    // unit, on its own page: along the seam, away from the apex (parallel: along fold_dir)
    Vec2 own_centre;  // unit, on its own page: along the centre fold, away from the apex (parallel: across,
                      // from the seam towards the centre fold)
    double near = 0.0;  // a, b: angle fold–seam (rad); parallel p, q: distance fold–seam (mm). > 0
    double far = 0.0;   // g, h: angle seam–centre fold; parallel s1, s2: distance
};

// Places its plates from plates placed before it. Joints stand in an order in which this works.
struct Joint {
    JointKind kind = JointKind::drive;
    bool parallel = false;
    std::string name;  // the element, or "page"
    Place place;
    Bar left,
        right;  // drive: left.plate, fold_at and fold_dir of the axis, near = -1 or +1: which way it turns
};

struct Assembly {
    std::string file;
    std::string stem;
    std::vector<Piece> pieces;
    std::vector<Plate> plates;
    std::vector<Line> lines;
    std::vector<Hinge> hinges;
    std::vector<Glue> glue;
    std::vector<Joint> joints;
    CurveTable curves;  // that chords of all pieces stand for
};

struct AssembleOptions {};

// Makes the plates' final outlines (cut-outs taken away, all at once a plate), cuts fills and drawn lines to
// the plates they lie on, and drops what a later cut took away from a fold. Guarantees: every plate has an
// outline with an area; every hinge's plates share its line; joints are in order. Cost: near linear in plates
// and lines.
std::optional<Assembly> assemble(const CheckedDesign& design, const AssembleOptions& options,
                                 Diagnostics& diagnostics);

}  // namespace popup
