// Paper that hangs together in single points only is two parts.
#pragma once

#include <vector>

#include "popup/geometry.h"

namespace popup::oa {

// The regions, taken apart wherever they hang together by single points: where a ring passes a corner twice,
// or a corner lies on an edge, within two steps of the grid. Precondition: they are results of
// base/geometry/regions.h. Cost: near linear in corners.
std::vector<Polygon> come_apart(std::vector<Polygon> regions);

}  // namespace popup::oa
