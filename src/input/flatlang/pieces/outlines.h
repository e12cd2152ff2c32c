// The closed loops of a trail as faces: flat paper with holes, where it stands in space.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "input/flatlang/turtle/trail.h"
#include "parts/work.h"
#include "popup/diagnostics.h"
#include "popup/geometry.h"

namespace popup::flatlang {

inline constexpr double kMmPerInch = 25.4;
// Parts lie this near to the origin, as flat_parts.h has it.
inline constexpr double kFarthestMm = 1e5;

// Finite, and no further from the origin than parts may be.
bool is_near(Vec3 inches);

// An outermost loop of a plane of one part, with all that lies in it. Lengths in mm.
struct Face {
    int part = 0;                // of the trail
    int plane = 0;               // faces of one plane and part have the same number, no others
    int first_polygon = 0;       // of those it is made of, the one that was closed first
    Frame frame;                 // of its plane; the front is the side from which it is drawn
    std::vector<Polygon> paper;  // in the plane; as Piece::paper
};

struct Outlines {
    std::vector<Face> faces;  // by their first polygons
    // Of each polygon its face, or one of its plane where it is drawn twice; -1: it has no area, or nothing
    // is left of it.
    std::vector<int> polygon_face;
    int covered = 0;  // outermost loops that make no face: the loops in them leave nothing
};

// Loops lie in one plane where they are within 1e-4 inch of it. A plane's front is the side that is seen from
// above; of an upright plane that from the front (-y), and of one that runs front to back that from the right
// (+x). So what is drawn on the ground lies on its page as it is drawn, whichever way the turtle went round.
// Seen from there x is to the right on the ground; on upright planes y is up.
//
// Loops that are drawn twice count once; loops without an area, lines there and back, make no face.
// Errors, `flatlang-bad-outline`: coordinates that are not finite or too far away, loops that do not lie in a
// plane, and in a part with a name loops that cross themselves, overlap others in part, or are covered wholly
// by the loops in them, which are holes;
// `document-too-large` where loops cross, touch or surround one another too often. Warnings:
// `flatlang-outlines-overlap`, the same of loops drawn before any part, each of which is a face of its own
// unless it is covered;
// `holes-overlap`. Nullopt after errors. Cost: near linear.
std::optional<Outlines> find_outlines(const Trail& trail, Work& work, Diagnostics& diagnostics);

}  // namespace popup::flatlang
