// An order of equations that leaves their factors sparse.
#pragma once

#include <vector>

#include "popup/geometry.h"

namespace popup::folded {

// By nested dissection (George, Nested dissection of a regular finite element mesh, 1973): equations lie at
// `places`, and join what lies near. Each set of `joined` names equations that have to do with each other, by
// numbers from 0. Returns the place of each in the order. Cost: n log² n, where sets are small.
std::vector<int> plane_order(const std::vector<std::vector<int>>& joined, const std::vector<Vec2>& places);

}  // namespace popup::folded
