// Lines that a drawing has twice.
#pragma once

#include <vector>

#include "popup/path.h"

namespace popup::edit {

// The path without subpaths that lie on an earlier one all along, corner on corner within 0.01 mm, in either
// direction and from whatever corner. `repeated`: a point of each that was left out, from the lower left
// corner of the drawing's box. Cost: near linear in steps, for subpaths whose boxes differ.
Path drawn_once(const Path& drawn, std::vector<Vec2>& repeated);

}  // namespace popup::edit
