// Drawings as cards: an SVG drawing of a pop-up that is cut from one sheet.
#pragma once

#include <optional>

#include "popup/design.h"
#include "popup/diagnostics.h"
#include "popup/files.h"
#include "popup/language.h"

namespace popup::drawing::card {

// The Design of the sheet that is drawn: its border is the page, the fold through its middle the gutter, and
// what cuts and folds make is told by elements of one sheet (features.h). See "Drawn cards" in popupc(1).
// What is not understood is a located error, and what was mended a repair.
std::optional<Design> read(const Source& source, const ReadOptions& options, Diagnostics& diagnostics);

}  // namespace popup::drawing::card
