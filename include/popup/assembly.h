// The Assembly: rigid plates, the lines on them, and how each plate's frame follows from others.
//
// The narrow waist. Nothing here or after it knows what a v-fold is.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "popup/design.h"
#include "popup/geometry.h"
#include "popup/joints.h"
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

// The openings that a motion goes through, and how it begins.
struct Sweep {
    double from_deg = 0.0;  // 0: closed
    double to_deg = 180.0;  // > from_deg
    // At from_deg all plates lie in one plane, that of the first cover, and come from there as linkages do
    // that fold flat: distances shrink with the angle.
    bool closed_flat = true;
};

struct Assembly {
    std::string file;
    std::string stem;
    std::vector<Piece> pieces;
    std::vector<Plate> plates;
    std::vector<Line> lines;
    std::vector<Hinge> hinges;
    std::vector<Glue> glue;
    std::vector<Joint> joints;  // in an order in which each finds its plates placed
    Sweep sweep;
    // The plates that are the card: nothing may stick out of them when it is closed. Left to right, those on
    // the left first; empty: nothing covers it.
    std::vector<int> covers;
};

struct AssembleOptions {};

// Makes the plates' final outlines (cut-outs taken away, all at once a plate), cuts fills and drawn lines to
// the plates they lie on, and drops what a later cut took away from a fold. Guarantees: every plate has an
// outline with an area; every hinge's plates share its line; joints are in order. Cost: near linear in plates
// and lines.
std::optional<Assembly> assemble(const CheckedDesign& design, const AssembleOptions& options,
                                 Diagnostics& diagnostics);

}  // namespace popup
