// Lines on flat paper: what they mean.
#pragma once

#include <string_view>

namespace popup {

// What a line of a pattern means to the one who makes it.
enum class LineKind { cut, mountain, valley, seam, mark };
std::string_view to_string(LineKind kind);

}  // namespace popup
