// Whether regions on the grid hold one another.
#pragma once

#include "nest/convex_parts.h"

namespace popup {

// Whether the region is inside the other, edges allowed, by integers alone. A no may be wrong where a corner
// of the other lies on an edge of it. Preconditions: rings have 3 corners or more and do not touch
// themselves; no hole of the other has all of its corners on the region's edge; coordinates are within ±2^60
// steps. Cost: m log n in corners, where few edges of the other come near one edge of it.
bool is_inside(const GridRegion& region, const GridRegion& other);

}  // namespace popup
