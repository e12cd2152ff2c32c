// Orders of equations that leave their factors sparse.
#pragma once

#include <vector>

#include "popup/geometry.h"

namespace popup::folded {

// Each set of `joined` names equations that have to do with each other; numbers from 0. Returns the place of
// each in the order.

// By nested dissection (George, Nested dissection of a regular finite element mesh, 1973): equations lie at
// `places`, and join what lies near. Cost: n log² n.
std::vector<int> plane_order(const std::vector<std::vector<int>>& joined, const std::vector<Vec2>& places);

// By least degree (Amestoy, Davis and Duff, An approximate minimum degree ordering algorithm, 1996).
std::vector<int> least_degree_order(const std::vector<std::vector<int>>& joined, int count);

}  // namespace popup::folded
