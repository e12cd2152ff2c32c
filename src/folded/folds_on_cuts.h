// Folds that lie on a cut which parts the sheet.
#pragma once

#include <vector>

#include "base/geometry/sheet_graph.h"
#include "folded/sheet.h"
#include "popup/crease_pattern.h"
#include "popup/diagnostics.h"

namespace popup::folded {

// A `fold-on-cut` warning for each two pieces that a cut parts on which a fold is drawn: the fold holds
// nothing there. A slit in a crease is none, because what lies on its sides is one piece. `panel_of` says of
// each face of the graph which panel it is; less than 0: none. Cost: linear in edges.
void tell_folds_on_cuts(const SheetGraph& graph, const std::vector<int>& panel_of,
                        const std::vector<Panel>& panels, const CreasePattern& pattern,
                        Diagnostics& diagnostics);

}  // namespace popup::folded
