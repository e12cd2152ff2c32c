// Ways to turn a piece.
#pragma once

#include <vector>

#include "nest/grid.h"
#include "popup/layout.h"

namespace popup {

// The usable part of a sheet, in mm.
struct SheetArea {
    double width = 0.0;
    double height = 0.0;
};

// The box of a ring turned, on the grid.
GridBox turned_box(const Ring& ring, Angle angle);

// Whether the ring, turned so, fits into the area.
bool fits(const Ring& hull, Angle angle, const SheetArea& area);

// The turns of a shape that are worth a look, each allowed by the rotation. Up to 12 in a circle: all. More,
// or any: as drawn, and those in which an edge of the hull lies level or upright and the box is smallest,
// each with its quarter turns as far as they are allowed; if none of them fits into any of the areas, also
// one that does, if there is one among the first 720 steps. At least one, no doubles. Angles are whole
// multiples of 1e-7°.
std::vector<Angle> turns_of(const Ring& hull, Rotation rotation, const std::vector<SheetArea>& areas);

}  // namespace popup
