// Booleans and offsets of polygons, and lines cut to polygons: a thin wrapper over an integer library.
//
// Everything is computed on a grid of 1e-6 mm: coordinates are rounded to it on the way in, and results stand
// on it. Results are canonical: outer rings counter-clockwise, holes clockwise, each ring from its lowest
// leftmost corner, polygons ordered by that corner; no corner in the middle of a straight edge (up to the
// grid), no ring without an area. So the same regions give the same bytes whatever their order. Coordinates
// must be finite and within ±1e9 mm. Cost: near linear in corners and crossings for drawings whose horizontal
// lines meet few edges; filled() by the even-odd rule is n log n for all whose edges do not meet.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/geometry/tolerances.h"
#include "popup/geometry.h"

namespace popup {

// p rounded to the grid, never -0.
Vec2 on_grid(Vec2 p);

// Regions may overlap and may be given with any orientation; each polygon is its outer ring less its holes.
std::vector<Polygon> unite(const std::vector<Polygon>& regions);
std::vector<Polygon> subtract(const std::vector<Polygon>& from, const std::vector<Polygon>& what);
std::vector<Polygon> intersect(const std::vector<Polygon>& a, const std::vector<Polygon>& b);

// What is inside of rings that are painted together, by their directions or by how many are around a point.
enum class FillRule { non_zero, even_odd };
std::vector<Polygon> filled(const std::vector<Ring>& rings, FillRule rule);

// A corner on an integer grid, within ±2^60.
struct RingCorner {
    std::int64_t x = 0, y = 0;
    bool operator==(const RingCorner&) const = default;
};
using CornerRing = std::vector<RingCorner>;

// The ring without doubled corners and corners in the middle of a straight edge; empty when none has an area.
// Spikes stay.
CornerRing without_straight_corners(const CornerRing& ring);

// Whether each ring lies within an odd number of others: it is a hole where they are painted together by the
// even-odd rule. nullopt: two edges have a point in common other than the corner between neighbours. Exact.
// Precondition: rings from without_straight_corners(). Cost: n log n in corners. The algorithm is the sweep
// of M. I. Shamos and D. Hoey, "Geometric intersection problems" (1976).
std::optional<std::vector<bool>> holes_of_simple_rings(const std::vector<CornerRing>& rings);

enum class Corners {
    sharp,    // mitred; corners sharper than about 29° are cut off square at the distance of the offset
    rounded,  // arcs as polygons that stray from the circle by at most 0.01 mm, inwards
};
// The points within `delta` mm of the regions, or for a negative delta those at least that far inside.
std::vector<Polygon> offset(const std::vector<Polygon>& regions, double delta, Corners corners);

// The parts of an open polyline that lie in the area, edges included, in the line's own direction and order.
// Parts shorter than 1e-6 mm are left out. Not rounded to the grid: corners of the line keep their exact
// values.
std::vector<std::vector<Vec2>> clip_line(const std::vector<Vec2>& line, const Polygon& area);
// The same for many lines of one area, each with its own result. Cost: near linear in lines, once the area is
// indexed.
std::vector<std::vector<std::vector<Vec2>>> clip_lines(std::span<const std::vector<Vec2>> lines,
                                                       const Polygon& area);

// The ring without corners that lie within `tolerance` of the straight line between their neighbours, doubled
// corners and spikes. Empty when nothing with an area is left.
Ring tidied(const Ring& ring, double tolerance);

}  // namespace popup
