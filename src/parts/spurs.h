// Where a closed line runs out and back on itself.
#pragma once

#include <vector>

#include "popup/geometry.h"

namespace popup {

// The stretches of a closed line that it runs along twice, there and straight back: as the slit of a part
// whose outline goes in from its edge and back, which encloses nothing and so is gone from what is inside.
// Each as an open line from its tip to where the two ways part; one that bends, as a whole. Where it
// branches, each branch is a line. None is shorter than drawing::kJoinMm, and the two ways are no further
// apart than kSameLineMm. A line between two areas, as the bridge from an outline to a hole, has no tip and
// is none of them. Example: {0,0} {10,0} {10,5} {5,5} {5,2} {5,5} {0,5} gives {5,2} {5,5}. Cost: linear.
std::vector<std::vector<Vec2>> spurs_of(const std::vector<Vec2>& closed);

}  // namespace popup
