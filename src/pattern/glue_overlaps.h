// Tabs and glued areas of two elements that want the same place on a side of a plate.
#pragma once

#include "pattern/tabs.h"
#include "popup/assembly.h"
#include "popup/diagnostics.h"

namespace popup {

// One `glue-overlaps` for an element where more than 5 mm, or a quarter, of one of its seams, or more than a
// quarter of an area, lies where an earlier tab or area is glued, before anything is trimmed: nothing of its
// own tab is left there. Areas come after all tabs. It names what takes most, and counts the other elements
// that were met until one takes it all. Tabs that come from two seams apart, and meet, are trimmed without a
// word. Cost: n log n in tabs and areas, and in pairs that are near each other and leave some of the later.
void report_glue_overlaps(const Assembly& assembly, const TabRules& rules, Diagnostics& diagnostics);

}  // namespace popup
