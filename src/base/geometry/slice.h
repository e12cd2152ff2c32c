// A polygon of very many corners cut in two, at a cost that grows as they do.
#pragma once

#include <vector>

#include "popup/geometry.h"

namespace popup {

// The parts of a polygon on either side of a line, which is where half of its corners lie to either side:
// level, or `upright`. Nothing where that cannot be told for certain, as where edges meet on the line: a
// boolean can tell. New corners lie on both parts alike and on a grid of 1e-6 mm along the line.
// Precondition: rings do not cross themselves or each other, but may touch. Cost: linear in corners, n log n
// in edges that are cut; holes are looked for in each part whose box they lie in.
std::vector<Polygon> slice(const Polygon& polygon, bool upright);

}  // namespace popup
