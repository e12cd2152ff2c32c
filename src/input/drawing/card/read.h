// Drawings as cards: the drawing of a pop-up that is cut from one sheet.
#pragma once

#include <optional>

#include "parts/tracing.h"
#include "popup/assembly.h"
#include "popup/design.h"
#include "popup/diagnostics.h"
#include "popup/files.h"

namespace popup::drawing::card {

// One of the two, or neither after an error.
struct CardReading {
    std::optional<Design> design;
    std::optional<Assembly> assembly;
};

// The sheet that is drawn: its border is the page, the fold through its middle the gutter. What cuts and
// folds make is told by elements of one sheet (features.h), and then it is a design; where they do not tell
// all, but the card is an origamic architecture (origamic_card.h), it is an assembly, which a
// `card-of-no-elements` remark says. See "Drawn cards" in popupc(1). What is not understood is a located
// error, and what was mended a repair. `source` is what the drawing was read from.
CardReading read(const Tracing& tracing, const Source& source, Diagnostics& diagnostics);

// Of a drawing that is read as a folded sheet without being asked to: a `may-be-card` remark where it is a
// pop-up card in all its lines, one element of which is enough. Cost: that of read().
void tell_card(const Tracing& tracing, const Source& source, Diagnostics& diagnostics);

}  // namespace popup::drawing::card
