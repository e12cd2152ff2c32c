// The outer cuts of a sheet with joints in them.
#pragma once

#include <span>

#include "output/sheet_drawing.h"

namespace popup {

// Of a drawing whose pieces have been drawn, and put in the machine's order: breaks the outer cuts of each
// piece as fabrication/joints.h has it, wherever the piece lies. Counts joints, and pieces with under two.
// Nothing where the profile has no joints. Cost: near linear in points.
void put_in_joints(SheetDrawing& drawing, const Layout& layout, std::span<const Placement> placements,
                   bool back);

}  // namespace popup
