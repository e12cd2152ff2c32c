// Drawings as cards: the drawing of a pop-up that is cut from one sheet.
#pragma once

#include <optional>

#include "parts/tracing.h"
#include "popup/design.h"
#include "popup/diagnostics.h"
#include "popup/files.h"

namespace popup::drawing::card {

// The Design of the sheet that is drawn: its border is the page, the fold through its middle the gutter, and
// what cuts and folds make is told by elements of one sheet (features.h). See "Drawn cards" in popupc(1).
// What is not understood is a located error, and what was mended a repair. `source` is what the drawing was
// read from.
std::optional<Design> read(const Tracing& tracing, const Source& source, Diagnostics& diagnostics);

// Of a drawing that is read as a folded sheet without being asked to: a `may-be-card` remark where it is a
// pop-up card in all its lines, one element of which is enough. Cost: that of read().
void tell_card(const Tracing& tracing, const Source& source, Diagnostics& diagnostics);

}  // namespace popup::drawing::card
