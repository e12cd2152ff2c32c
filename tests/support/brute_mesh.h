// Plates as triangles, for brute force: outlines shrunk by GEOS and triangulated by CGAL.
#pragma once

#include <array>
#include <vector>

#include "popup/geometry.h"

namespace popup::test {

// Triangles lower than this are not tested: placed, they could be straight lines.
inline constexpr double kSliverMm = 1e-7;

// Triangles of a page's region.
struct Mesh {
    std::vector<Vec2> points;
    std::vector<std::array<int, 3>> corners;  // indices into points
    std::vector<bool> sliver;                 // of each triangle: lower than kSliverMm
};

// All points further than `by` mm inside the polygon's edges, to 2 % of that: round a corner that points
// inwards the result is a polyline.
std::vector<Polygon> shrunk(const Polygon& polygon, double by);

// Triangles of polygons that do not overlap. Aborts when these do not make up their area.
Mesh triangulated(const std::vector<Polygon>& polygons);

}  // namespace popup::test
