// Paper that hangs together in single points only is two parts.
#pragma once

#include <vector>

#include "popup/geometry.h"

namespace popup::oa {

// The regions, none of whose rings passes a corner twice, or hangs by corners that lie on edges, to two steps
// of the grid: they are taken apart there. Precondition: they are results of base/geometry/regions.h. Cost:
// near linear in corners; in such regions times their parts.
std::vector<Polygon> come_apart(std::vector<Polygon> regions);

}  // namespace popup::oa
