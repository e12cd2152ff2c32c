// Kinds of pieces made ready for the search: each allowed turn as convex parts, widened by half the spacing.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "nest/convex_parts.h"
#include "nest/grid.h"
#include "popup/nest.h"

namespace popup {

// An edge of a convex part, in steps: where it begins, its normal outwards, of length 1, and its direction as
// a number that grows from 0 to 4 once round the circle, from the direction of x.
struct PartEdge {
    double x, y;
    double nx, ny;
    double direction;
    bool slanted;  // neither upright nor level
    int eighth;    // 0, 2, 4, 6: right, up, left, down; 1, 3, 5, 7: between them, from right to up on
};

// The edges of a convex ring by their direction.
struct RingEdges {
    std::vector<PartEdge> edges;
    std::array<std::uint32_t, 8> counts{};          // how many of each eighth
    double x0 = 0.0, y0 = 0.0, x1 = 0.0, y1 = 0.0;  // box of its corners
};

// A convex part's, as it is and mirrored at the origin.
struct PartEdges {
    RingEdges plain, mirrored;
};

// A kind in one of its turns.
struct TurnedShape {
    int kind = 0;
    Angle angle;
    std::vector<GridRegion> outline;  // as it is cut: turned and rounded to the grid
    // Convex parts that make up the outline, its holes filled where they may not be used; of an outline of
    // thousands of corners, one of few that holds it. Where that could not be proved, those of the outline
    // widened by some steps, more than rounding can have taken from it.
    std::vector<GridRing> exact;
    GridBox bounds;                // of the outline; what must lie on the sheet
    std::vector<GridRing> parts;   // convex, covering the outline, each widened by half the spacing
    GridBox reach;                 // of the parts
    std::vector<PartEdges> edges;  // of each part
};

// All kinds of a job in all their turns.
struct ShapeSet {
    std::vector<TurnedShape> shapes;
    std::vector<std::vector<int>> of_kind;  // a kind: its shapes, in the order of its turns
    std::vector<double> areas;              // a kind: area of its outline in mm²
    bool exact = false;  // the parts are the outlines themselves, not wider and not coarser
};

// Precondition: the job is well formed (see popup/nest.h). Cost: near linear in corners, with a turn at a
// time.
ShapeSet make_shapes(const NestJob& job);

// The outline turned, each polygon by itself, on the grid.
std::vector<GridRegion> turned_outline(const std::vector<Polygon>& outline, Angle angle);

}  // namespace popup
