// Lines on flat paper: what they mean, and how they are drawn.
#pragma once

#include <string_view>
#include <vector>

#include "popup/design.h"
#include "popup/geometry.h"

namespace popup {

// What a line of a pattern means to the one who makes it.
enum class LineKind { cut, mountain, valley, seam, mark };
std::string_view to_string(LineKind kind);

// A drawn line as it lies on the paper. Points in the coordinates of its page.
struct Stroke {
    std::vector<Vec2> points;  // at least two
    double width_mm = 0.0;
    Color color;
};

}  // namespace popup
