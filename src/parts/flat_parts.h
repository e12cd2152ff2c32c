// Flat parts as readers find them, on their way into an Assembly.
//
//   FlatParts found;
//   FlatPart& part = found.parts.emplace_back();
//   part.name = "gear";
//   part.paper = {{{{0, 0}, {20, 0}, {0, 20}}, {}}};
//   Assembly assembly = assembly_of(std::move(found));
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "popup/assembly.h"
#include "popup/curves.h"
#include "popup/diagnostics.h"
#include "popup/geometry.h"
#include "popup/lines.h"
#include "popup/print.h"

namespace popup {

struct FlatLine {
    LineKind kind = LineKind::valley;  // mountain, valley, seam or mark; cuts are edges of paper, or slits
    std::vector<Vec2> points;          // at least two
    // Of a fold: how far it is folded in the finished part, (0, pi]; where that is known.
    std::optional<double> fold_angle = {};
};

// A flat face of a folded part: `frame` maps the part's page to where the face stands, in mm.
struct FlatFace {
    Polygon shape;  // on the page
    Frame frame;
};

// What is cut out as one. In millimetres, y up, within ±1e5 of an origin that all parts of an input share.
struct FlatPart {
    std::string name;  // unique in its input, not empty
    Place place;       // in the source
    // What is left when everything is cut, as Piece::paper; at least one region.
    std::vector<Polygon> paper;
    std::vector<std::vector<Vec2>> slits;  // cuts besides, open; each has at least two points
    std::vector<FlatLine> lines;
    std::vector<Area> fills;  // in the order in which they are painted
    std::vector<Stroke> strokes;
    std::vector<Text> texts;
    std::vector<FlatFace> faces;            // where its paper stands; none: that is not known
    std::vector<std::vector<Vec3>> traces;  // lines in space that it was drawn with
};

struct FlatParts {
    std::vector<FlatPart> parts;  // at least one
    std::vector<Trace> traces;    // those of no part
    CurveTable curves = {};       // that chords of all parts stand for
};

// A piece of each part, in their order, that nothing moves. Its plates are its faces, which stand; where
// these are not known, the regions of its paper. A plate has the name of its part where there is one, else
// "gear/1", "gear/2". Cost: linear.
Assembly assembly_of(FlatParts parts);

}  // namespace popup
