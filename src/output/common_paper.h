// Where two plates that lie in one plane have paper in one place.
#pragma once

#include "popup/geometry.h"

namespace popup {

// The paper that two plates of one plane have in common, both given on one page: the largest part of it,
// without its holes. Empty if no part has more than 1 mm²; so plates that only touch have none. Cost: linear
// in corners for most of those that touch along an edge; else as an intersection of two regions.
Ring common_paper(const Polygon& a, const Polygon& b);

}  // namespace popup
