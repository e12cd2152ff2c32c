// Faces in space unfolded into flat pieces.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "input/flatlang/pieces/outlines.h"
#include "parts/work.h"
#include "popup/geometry.h"

namespace popup::flatlang {

// A face in its piece: `frame` maps the piece's page to where the face stands.
struct UnfoldedFace {
    int face = 0;  // into the faces that were given
    Frame frame;
    std::vector<Polygon> paper;  // on the page
};

// A line of a piece's page along which it is folded. The angle is that by which the face on one side is
// turned out of the plane of the other: positive when the fronts come together (a valley), negative for a
// mountain, 0 where both lie in one plane; within [-pi, pi].
struct Crease {
    Vec2 from, to;
    double angle = 0.0;
};

struct Unfolded {
    std::vector<UnfoldedFace>
        faces;                   // the first as it lies in its plane; in the order in which they were hung
    std::vector<Polygon> paper;  // what all faces have together, as Piece::paper
    std::vector<Crease> creases;
    std::vector<Segment> slits;  // where faces touch on the page that are not joined there
};

// Pieces of the faces of one part of a trail, by their first faces. Faces that share a stretch of an edge
// with each other, and with no third, are joined there; those of one plane only if `join_flat`. From the
// first face on, breadth first and in the order of the faces, each is hung on the first that it shares an
// edge with and where it does not overlap what hangs already; a face that finds no place begins a piece of
// its own. Edges of one piece that come to lie on each other on the page as they do in space are folds too,
// others are cut. Nullopt when the work left does not do. Cost: near linear where few faces come near each
// other.
std::optional<std::vector<Unfolded>> unfold_faces(std::span<const Face> faces, bool join_flat, Work& work);

}  // namespace popup::flatlang
