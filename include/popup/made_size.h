// Whether pieces can still be glued when they are made smaller than they are drawn.
#pragma once

#include "popup/assembly.h"
#include "popup/diagnostics.h"
#include "popup/pattern.h"

namespace popup {

// What make_pattern() finds is of pieces as they are drawn. This finds what is too small only as it is made,
// at a scale as LayoutOptions has it, with both sizes. Warning: `tab-too-small`, once for all tabs where the
// scale leaves them less than 3 mm of depth, or than the depth that was asked for if that is less; else of
// each tab that has under 3 mm along half its seam or more then; and of the smallest area that is glued flat
// and has less than 25 mm² then. Nothing is found at a scale of 1 or more. Precondition: scale > 0. Cost:
// that of judge_tabs().
void judge_made_size(const Assembly& assembly, const PatternOptions& options, double scale,
                     Diagnostics& diagnostics);

}  // namespace popup
