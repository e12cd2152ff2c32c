// Ways to turn a shape, and the box it then takes.
#pragma once

#include <cstdint>
#include <vector>

#include "layout/pack.h"

namespace popup {

// p turned counter-clockwise about the origin; exact for quarter turns.
Vec2 turned(Vec2 p, Angle angle);

// Lengths on the grid of 1e-6 mm, on which places are found and checked exactly.
using GridLength = std::int64_t;
GridLength to_grid(double mm);
double from_grid(GridLength length);

// A shape turned: the box it takes and where its lower left corner lies.
struct Pose {
    Angle angle;
    GridLength x = 0, y = 0;
    GridLength width = 0, height = 0;
};
Pose pose_of(const Ring& hull, Angle angle);

// The allowed turn with the smallest box that lies in the area, and the same with a quarter turn more where
// that is allowed and fits. Turns that save less than 0.1 % of the box are not taken. Empty: none fits.
std::vector<Pose> poses_in(const Ring& hull, const SheetArea& area, Rotation rotation);

}  // namespace popup
