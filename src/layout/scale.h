// Patterns made larger or smaller.
#pragma once

#include "popup/pattern.h"

namespace popup {

// Scales everything that has a size, about the origin: points, widths of drawn lines, heights of text.
// Precondition: by > 0.
void scale_pattern(Pattern& pattern, double by);

}  // namespace popup
