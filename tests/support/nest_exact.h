// What the check of nested pieces asks of CGAL: areas in common and distances, exactly, in steps of the grid.
#pragma once

#include <cstdint>
#include <vector>

namespace popup::test {

// A point of the grid, in its steps.
struct GridSpot {
    std::int64_t x = 0;
    std::int64_t y = 0;
    friend bool operator==(const GridSpot&, const GridSpot&) = default;
    friend auto operator<=>(const GridSpot&, const GridSpot&) = default;
};

// A piece in its place: what lies inside of its rings, outer ones counter-clockwise and holes clockwise.
using PlacedPiece = std::vector<std::vector<GridSpot>>;

// Two pieces, by number, a < b, and what they have in common: its area and the box that holds it.
struct PieceOverlap {
    int a = 0, b = 0;
    double area = 0.0;  // steps squared, > 0
    double x0 = 0.0, y0 = 0.0, x1 = 0.0, y1 = 0.0;
};

// All pairs that have inner points in common, by a, then b. Edges and corners in common are none.
std::vector<PieceOverlap> piece_overlaps(const std::vector<PlacedPiece>& pieces);

// Whether p is closer to the segment than `steps`.
bool closer_than(GridSpot p, GridSpot from, GridSpot to, std::int64_t steps);

}  // namespace popup::test
