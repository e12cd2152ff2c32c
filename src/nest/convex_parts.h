// Regions as convex parts: two regions overlap exactly where a part of one overlaps a part of the other.
#pragma once

#include <vector>

#include "nest/grid.h"

namespace popup {

// A region on the grid: an outer ring, counter-clockwise, and holes, clockwise.
struct GridRegion {
    GridRing outer;
    std::vector<GridRing> holes;
};

// Convex rings, counter-clockwise, without corners in the middle of an edge, that cover the region and do not
// overlap: triangles joined along the longest edges first, as long as the union stays convex. Empty when the
// region has no area. Cost: that of the triangulation, and n log n.
std::vector<GridRing> convex_parts(const GridRegion& region);

// The points within `by` ≥ 0 steps of a convex ring, and a little more at sharp corners, which are cut off
// square; a convex ring again. Level and upright edges move by exactly `by`, others to within a step.
GridRing widened(const GridRing& part, GridLength by);

// The region with corners taken away so that it only grows: notches filled, and short edges replaced by the
// corner in which their neighbours meet, the least area first, until `most_added` (in steps squared) would be
// exceeded. No new corner lies further than `furthest` steps from an old edge. New corners are rounded to the
// grid, so an edge may end up one step inside of where it was. What grows may grow over itself. Cost:
// quadratic in corners.
GridRegion coarser(const GridRegion& region, double most_added, double furthest);

}  // namespace popup
