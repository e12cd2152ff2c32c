// Tabs and glued areas of two elements that want the same place on a plate.
#pragma once

#include "popup/assembly.h"
#include "popup/diagnostics.h"
#include "popup/pattern.h"

namespace popup {

// One `glue-overlaps` for an element where more than 5 mm, or a quarter, of one of its seams lies where a tab
// of an earlier one is glued, before anything is trimmed: nothing of its own tab is left there. It names the
// earlier tab that takes most of a seam, and counts the other elements that were met until one takes it all.
// Tabs that come from two seams apart, and meet, are trimmed without a word. The hint is a move that was
// tried, where the options know of one. One `glue-overlaps`, too, of a piece that is glued flat where the
// same piece is glued already. Else paper may be glued on paper that lies flat on the same side of the same
// plate; `target-covered` remarks on what is hidden of marks then: at least 9/10 of an area by one that the
// assembly names before, and, once an element, more than 5 mm, or a quarter, of a seam, by an area out of
// which the wall rises there. Cost: n log n in tabs and areas, and in pairs that are near each other and
// leave some of the later seam, and that of trying moves for a few elements.
void report_glue_overlaps(const Assembly& assembly, const PatternOptions& options, Diagnostics& diagnostics);

}  // namespace popup
