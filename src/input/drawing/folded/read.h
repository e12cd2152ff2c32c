// Drawings of cuts and folds as crease patterns.
#pragma once

#include <optional>

#include "parts/tracing.h"
#include "popup/crease_pattern.h"
#include "popup/diagnostics.h"
#include "popup/files.h"

namespace popup::drawing::folded {

// Takes a drawing for the sheet of something folded. What a line is follows the cascade of cards
// (input/drawing/card/lines.h). Folds in the exact colours of Origami Simulator, #ff0000 and #0000ff, are
// folded by their opacity times 180°, where the format has opacity, but for sheets of this program; all
// others do not say how far. What the drawing says with data-fold-angle counts before that. Of mountains and
// valleys the drawing shows the front of the paper. Remarks: `line-meaning`. `source` is what the drawing was
// read from.
std::optional<CreasePattern> read(const Tracing& tracing, const Source& source, Diagnostics& diagnostics);

}  // namespace popup::drawing::folded
