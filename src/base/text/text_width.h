// How wide text is before it is drawn.
#pragma once

#include <string_view>

namespace popup {

// Width of a line of text in DejaVu Sans whose capitals are `cap_height` high; never too small.
double text_width(std::string_view text, double cap_height);

}  // namespace popup
