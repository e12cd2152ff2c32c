// How large a carton is, flat and closed.
#pragma once

#include "folded/carton/rough.h"

namespace popup::folded {

// The remark `carton-size` for each piece: its blank, its area, its outer size with board of that caliper,
// mm, along the longest edge of its first panel, across it and upright on it, and what it holds, which is the
// hull of its panels less half a caliper on all sides.
void tell_carton_size(const RoughShape& shape, double board_mm, Diagnostics& diagnostics);

}  // namespace popup::folded
