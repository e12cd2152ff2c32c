// A smooth closed curve through given points.
#pragma once

#include <optional>
#include <span>

#include "popup/path.h"

namespace popup {

// The closed Catmull–Rom curve with α = 1 (chordal parameters), as one cubic from each point to the next:
// the tangent at a point is that of the parabola through it and its neighbours (Catmull and Rom 1974; Yuksel,
// Schaefer and Keyser 2011 have the controls). Points within 0.01 mm of the one before count once. nullopt:
// fewer than three points are left.
std::optional<Path> catmull_rom(std::span<const Vec2> points);

}  // namespace popup
