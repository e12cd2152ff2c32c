// Dashed lines that a drawing has in pieces.
#pragma once

#include "parts/tracing.h"
#include "popup/diagnostics.h"

namespace popup::drawing {

// Where dashes are aligned to ends and corners, Illustrator writes the first and last dash of a line, and
// what goes round a corner, as solid lines a gap away from the rest. A straight piece that is no longer than
// a dash of a dashed line of its colour, width and name, and goes on in its direction a gap behind its end,
// becomes a part of that line. A `dashes-joined` remark tells how many did. Cost: near linear.
void join_dashes(Tracing& tracing, Diagnostics& diagnostics);

}  // namespace popup::drawing
