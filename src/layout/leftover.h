// What is left of a sheet.
#pragma once

#include <vector>

#include "layout/turns.h"
#include "nest/convex_parts.h"
#include "popup/geometry.h"

namespace popup {

// A rectangle, sides along the sheet's, that lies in the area and keeps `spacing` mm from all pieces (holes
// are free). It cannot be made larger on any side, and is the largest there is up to the width of a cell on
// each side; the cells in which it is looked for are 1/400 of the area's longer side. Empty when no whole
// cell is free. Cost: cells, and pieces' edges times the cells they cross.
Box largest_free(const std::vector<std::vector<GridRegion>>& pieces, const SheetArea& area, double spacing);

}  // namespace popup
