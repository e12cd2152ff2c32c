// Whether regions on the grid hold one another.
#pragma once

#include "nest/convex_parts.h"

namespace popup {

// Whether the region is inside the other, edges allowed, by integers alone. A no may be wrong where a corner
// of the other lies on an edge of it. Precondition: coordinates within ±2^60 steps. Cost: m log n in corners,
// where few edges of the other come near one edge of it.
bool is_inside(const GridRegion& region, const GridRegion& other);

}  // namespace popup
