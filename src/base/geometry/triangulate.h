// Polygons as triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "popup/geometry.h"

namespace popup {

struct Triangulation {
    std::vector<Vec2> points;  // each point of the plane once
    std::vector<std::array<std::uint32_t, 3>> triangles;
};

// Triangles that cover the polygon exactly: their union is the polygon, no two overlap, each runs
// counter-clockwise and has an area. All corners of the polygon are corners of triangles, but for those in
// the middle of a straight edge, and there are no others, except in a polygon of many hundred corners: that
// is first cut into parts along upright and level lines, with the corners of the cuts on a grid of 1e-6 mm.
// The answer depends on the polygon alone. Empty when the polygon has no area.
// Preconditions: finite coordinates within ±1e9 mm; rings do not cross themselves or each other, but may
// touch. Cost: near linear.
// `uncut`: up to so many corners the polygon is not cut first; the time grows with their square.
Triangulation triangulate(const Polygon& polygon, std::size_t uncut = 300);

// How a polygon of very many corners is cut in two, at a cost that grows as they do: its parts on either side
// of a line that has half of its corners on either side, level or `upright`. Nothing where that cannot be
// told for certain, as where edges meet on the line: a boolean can tell. New corners are corners of parts on
// both sides, on a grid of 1e-6 mm along the line. Precondition: as of triangulate(). Cost: linear in
// corners, n log n in edges that are cut; a hole is looked for in each part whose box it lies in.
std::vector<Polygon> slice(const Polygon& polygon, bool upright);

}  // namespace popup
