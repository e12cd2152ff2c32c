// Lines of a drawing that follow the corners of the sheet that was read from them.
#pragma once

#include "folded/sheet.h"
#include "popup/crease_pattern.h"
#include "popup/sheet_edit.h"

namespace popup::folded {

// The lines of a pattern with the corners of its sheet where they went. `before` is the sheet cut apart, and
// `after` the same with other corners. Ends that the reading moved to what they meant to meet go as what they
// meet. Cost: n log n in corners, and lines that part times edges.
EditedSheet follow_lines(const CreasePattern& pattern, const FoldOptions& options, const Sheet& before,
                         const Sheet& after);

}  // namespace popup::folded
