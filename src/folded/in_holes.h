// What lies in holes of the sheet: it is neither cut nor folded.
#pragma once

#include <vector>

#include "base/geometry/sheet_graph.h"
#include "popup/crease_pattern.h"
#include "popup/diagnostics.h"

namespace popup::folded {

// A `falls-out` warning for each element that is cut with no paper of the sheet on either side. `levels` says
// of each face how many cuts lie between it and the outside: 1 is the sheet, 2 a hole. Cost: linear in edges.
void tell_cuts_in_holes(const SheetGraph& graph, const std::vector<int>& levels, const CreasePattern& pattern,
                        Diagnostics& diagnostics);

// The same of a part with folds, told at the face.
void tell_part_in_hole(const SheetGraph& graph, int face, const CreasePattern& pattern,
                       Diagnostics& diagnostics);

}  // namespace popup::folded
