// Tabs of two elements that want the same place on a plate.
#pragma once

#include "pattern/tabs.h"
#include "popup/assembly.h"
#include "popup/diagnostics.h"

namespace popup {

// One `glue-overlaps` for two elements where more than 5 mm, or a quarter, of a seam of the later one lies
// where an earlier tab is glued, before anything is trimmed: nothing of its own tab is left there. Tabs that
// come from two seams apart, and meet, are trimmed without a word. Cost: n log n in tabs, and in pairs that
// are near each other.
void report_glue_overlaps(const Assembly& assembly, const TabRules& rules, Diagnostics& diagnostics);

}  // namespace popup
