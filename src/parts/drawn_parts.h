// From the flat lines of a drawing to its parts.
#pragma once

#include <optional>

#include "parts/flat_parts.h"
#include "parts/tracing.h"
#include "popup/diagnostics.h"

namespace popup::drawing {

// Every outermost closed contour is a part; what lies in it goes with it. What belongs to a piece of a sheet
// of this program's own makes parts on its own, so that pieces may lie in one another's holes.
// Errors: `no-contours`, `contours-overlap`, `document-too-large`. Warnings and remarks for all that is left
// out or mended.
std::optional<FlatParts> make_parts(const Tracing& tracing, Diagnostics& diagnostics);

}  // namespace popup::drawing
