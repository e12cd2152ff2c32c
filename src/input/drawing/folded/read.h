// Drawings of cuts and folds as crease patterns.
#pragma once

#include <optional>

#include "popup/crease_pattern.h"
#include "popup/diagnostics.h"
#include "popup/files.h"
#include "popup/language.h"

namespace popup::drawing::folded {

// Reads an SVG drawing as the sheet of something folded. What a line is follows the cascade of cards
// (input/drawing/card/lines.h). Folds in the exact colours of Origami Simulator, #ff0000 and #0000ff, are
// folded by their opacity times 180°; all others do not say how far. Of mountains and valleys the drawing
// shows the front of the paper. Errors and findings: those of drawings, and `line-meaning`.
std::optional<CreasePattern> read(const Source& source, const ReadOptions& options, Diagnostics& diagnostics);

}  // namespace popup::drawing::folded
