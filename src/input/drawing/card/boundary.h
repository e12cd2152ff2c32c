// The border of several faces of a sheet.
#pragma once

#include <vector>

#include "base/geometry/sheet_graph.h"

namespace popup::drawing::card {

// Halves, each from where the one before ends, with the faces on their left: the loop around the largest
// area. Empty when the faces have none.
std::vector<int> outer_boundary(const SheetGraph& graph, const std::vector<int>& faces);

}  // namespace popup::drawing::card
