// The distance of two triangles in space.
#pragma once

#include <array>

#include "popup/geometry.h"

namespace popup {

struct ClosestPoints {
    double distance = 0.0;  // 0 where they meet
    Vec3 on_a, on_b;
};

// True only if they are further apart than `distance`: a plane keeps them apart that is parallel to one of
// them, square to one of them along an edge, or square to the line between their middles. Much quicker than
// the distance itself.
bool surely_apart(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, double distance);

// Triangles may be degenerate. Exact to rounding.
ClosestPoints closest_points(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b);

}  // namespace popup
