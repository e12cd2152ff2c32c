// What a pattern would say of its glue tabs, for who needs no pattern.
#pragma once

#include "popup/pattern.h"

namespace popup {

// Finds what make_pattern() finds, in the same order. Cost: that of the tabs alone; no piece is drawn.
void judge_tabs(const Assembly& assembly, const PatternOptions& options, Diagnostics& diagnostics);

}  // namespace popup
