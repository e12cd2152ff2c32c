// Patterns made larger or smaller.
#pragma once

#include "popup/pattern.h"

namespace popup {

// Scales everything that has a size, about the origin: points, widths of drawn lines, heights of text. In a
// pattern that becomes larger, chords of curves that are still there become more and shorter ones, which
// stray from the curves by kFlatMm as those before did; the pattern's curves are those of the new chords
// then. Precondition: by > 0. Cost: near linear in points.
void scale_pattern(Pattern& pattern, double by);

}  // namespace popup
