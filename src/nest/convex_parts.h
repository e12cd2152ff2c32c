// Regions as convex parts: two regions overlap exactly where a part of one overlaps a part of the other.
#pragma once

#include <cstddef>
#include <vector>

#include "nest/grid.h"

namespace popup {

// A region on the grid: an outer ring, counter-clockwise, and holes, clockwise.
struct GridRegion {
    GridRing outer;
    std::vector<GridRing> holes;
    friend bool operator==(const GridRegion&, const GridRegion&) = default;
};

// Parts of a region of more corners have corners beside its edges, by rounding: it is cut first.
inline constexpr std::size_t kMostUncutCorners = 4000;

// Convex rings, counter-clockwise, without corners in the middle of an edge, that cover the region and do not
// overlap: triangles joined along the longest edges first, as long as the union stays convex. Empty when the
// region has no area. Cost: that of the triangulation, and n log n.
std::vector<GridRing> convex_parts(const GridRegion& region);

// The points within `by` ≥ 0 steps of a convex ring, and a little more at sharp corners, which are cut off
// square; a convex ring again. Level and upright edges move by exactly `by`, others to within a step.
GridRing widened(const GridRing& part, GridLength by);

}  // namespace popup
