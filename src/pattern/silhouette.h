// The outline of a piece's paper.
#pragma once

#include <vector>

#include "popup/geometry.h"

namespace popup {

// The union of regions that share edges, as plates of a piece do. Gaps and slits thinner than a hair (0.02
// µm), which only rounding makes, are closed; corners stay where they are. Cost: near linear.
std::vector<Polygon> silhouette_of(const std::vector<Polygon>& regions);

}  // namespace popup
