// What a drawing shows only to some readers.
#pragma once

#include <string_view>

#include "input/drawing/shapes.h"

namespace popup::drawing {

// Whether an element is drawn at all (SVG 2, 5.7): it asks for no extensions, which nobody has here, and for
// no languages but English, in which this program speaks.
bool conditions_hold(const Attributes& attributes);

// Whether a style element is in CSS, and for screens: there people see what they draw.
bool is_style_for_us(std::string_view media, std::string_view type);

}  // namespace popup::drawing
