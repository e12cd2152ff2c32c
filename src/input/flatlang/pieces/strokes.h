// Outlines that were drawn in several strokes.
#pragma once

#include <vector>

#include "input/flatlang/turtle/trail.h"

namespace popup::flatlang {

// The loops that these segments of a trail (`numbers` ascend) close without the turtle having gone round in
// one go: of each part, where every end meets exactly one other (within 1e-4 inches an axis) and all lies in
// one plane. A line that is drawn twice counts once. In the order of their first segments. Precondition:
// coordinates are finite. Cost: near linear.
std::vector<TrailPolygon> loops_of_strokes(const Trail& trail, const std::vector<std::size_t>& numbers);

}  // namespace popup::flatlang
