// The Design of a drawn card.
#pragma once

#include "input/drawing/card/leftovers.h"
#include "popup/design.h"
#include "popup/diagnostics.h"

namespace popup::drawing::card {

// A structure of each feature, parents first, then the holes: box-fold for rectangles, polygon and freeform
// for other shapes between parallel folds, beak, angled-step and v-fold-cut for folds that meet. Curves stay
// curves. What is printed is printed on the page. `moves`: where points of the drawing's curves have moved.
// Errors: `not-understood`, `document-too-large`.
Design make_design(const Tracing& tracing, const SheetGraph& graph, const CardPage& page,
                   const Features& features, const std::vector<DrawnHole>& holes,
                   const std::vector<const TracedLine*>& printed, std::vector<Segment> moves,
                   Diagnostics& diagnostics);

}  // namespace popup::drawing::card
