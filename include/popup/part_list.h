// The PartList: flat parts that do not move, as drawings and programs describe them. Nothing has to be
// checked or simulated: make_pattern() makes a piece of each part as it is.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "popup/curves.h"
#include "popup/design.h"
#include "popup/diagnostics.h"
#include "popup/geometry.h"
#include "popup/lines.h"

namespace popup {

struct PartLine {
    LineKind kind = LineKind::valley;  // mountain, valley, seam or mark; cuts are edges of paper, or slits
    std::vector<Vec2> points;          // at least two
    // Of a fold: how far it is folded in the finished part, (0, pi]; where that is known.
    std::optional<double> fold_angle = {};
};

// An area that is printed.
struct PartFill {
    Polygon area;
    Color color;
};

// Text that is printed. `at` is its middle.
struct PartText {
    std::string text;
    Vec2 at;
    double height_mm = 4.0;  // of the capitals, > 0
    double angle = 0.0;      // radians, counter-clockwise
};

// What is cut out as one. In millimetres, y up, within ±1e5 of an origin that all parts of a list share.
struct Part {
    std::string name;  // unique in its list, not empty
    Place place;       // in the source
    // What is left when everything is cut, as base/regions.h has it: regions that do not overlap, at least
    // one. Every edge is a cut. A region that lies in a hole of another comes out loose; it belongs to the
    // part all the same.
    std::vector<Polygon> paper;
    std::vector<std::vector<Vec2>> slits;  // cuts besides, open; each has at least two points
    std::vector<PartLine> lines;
    std::vector<PartFill> fills;  // in the order in which they are painted
    std::vector<Stroke> strokes;
    std::vector<PartText> texts;  // when there are any, the part's name is not printed
};

// A flat face in space: `frame` maps the shape's plane to where it stands, in mm.
struct StillFace {
    Polygon shape;
    Frame frame;
};

struct StillNode {
    std::string name;  // unique in its model, not empty
    std::vector<StillFace> faces;
    std::vector<std::vector<Vec3>> lines;  // in mm; each has at least two points
};

// Parts as they stand in space, and what was drawn to make them.
struct StillModel {
    std::vector<StillNode> nodes;  // at least one, none of them empty
};

struct PartList {
    std::vector<Part> parts;
    CurveTable curves;                // that chords of all parts stand for
    std::optional<StillModel> model;  // of languages that describe where their parts stand
};

}  // namespace popup
