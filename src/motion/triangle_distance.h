// The distance of two triangles in space.
#pragma once

#include <array>

#include "popup/geometry.h"

namespace popup {

struct ClosestPoints {
    double distance = 0.0;  // 0 where they meet
    Vec3 on_a, on_b;
};

// Triangles may be degenerate. Exact to rounding.
ClosestPoints closest_points(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b);

}  // namespace popup
