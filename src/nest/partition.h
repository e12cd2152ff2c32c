// Outlines as convex parts that are proved to make them up.
#pragma once

#include <optional>
#include <vector>

#include "nest/convex_parts.h"

namespace popup {

// Whether the directed edges of all parts, those that run both ways cancelled, are the directed edges of the
// outline. Then the parts' indicator functions add up to the outline's, whatever made the parts. Exact.
// Cost: n log n in edges.
bool make_up(const std::vector<GridRing>& parts, const std::vector<GridRegion>& outline);

// The outline's convex parts; nullopt when they do not make it up: rounding made it cross itself, or it has
// thousands of corners and had to be cut at places that are not on the grid.
std::optional<std::vector<GridRing>> partition(const std::vector<GridRegion>& outline);

}  // namespace popup
