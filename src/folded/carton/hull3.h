// The convex hull of points in space, by its volume and its surface.
#pragma once

#include <span>

#include "popup/geometry.h"

namespace popup::folded {

struct HullSize {
    double volume = 0.0;   // mm³
    double surface = 0.0;  // mm²
};

// Both 0 of points that lie in one plane to a millionth of their extent. Points are added one after another,
// the furthest first (Barber and others, The Quickhull algorithm, 1996). Cost: points times faces.
HullSize hull_size(std::span<const Vec3> points);

}  // namespace popup::folded
