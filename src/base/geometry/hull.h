// The convex hull of points.
#pragma once

#include <vector>

#include "popup/geometry.h"

namespace popup {

// Counter-clockwise, from the leftmost (then lowest) point, without points in the middle of an edge.
// Fewer than three corners when the points lie on a line. Cost: n log n.
Ring convex_hull(std::vector<Vec2> points);

}  // namespace popup
