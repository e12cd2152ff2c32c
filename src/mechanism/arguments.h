// Drawn arguments of elements, moved as the page they are drawn on moves.
#pragma once

#include <array>

#include "popup/design.h"

namespace popup {

// A map of the plane: the point (x, y) comes to (a x + c y + e, b x + d y + f).
using Placed = std::array<double, 6>;
inline constexpr Placed kMirrored{-1, 0, 0, 1, 0, 0};  // x to -x

// A path or points: what is drawn on a page.
inline bool is_drawn(const Argument& argument) {
    return std::holds_alternative<DrawnPath>(argument.value) ||
           std::holds_alternative<std::vector<DesignPoint>>(argument.value);
}

// Moves a path or points, on whatever page they are; anything else stays as it is. Does not set `changed`.
void move_argument(Argument& argument, const Placed& by);

}  // namespace popup
