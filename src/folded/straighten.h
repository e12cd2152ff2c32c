// Folds that pass through a corner in one line, and corners that fold flat, but for the rounding of a
// drawing, made straight and flat.
//
// Where two lines of a map cross at anything but right angles only one of them can be folded, and no shares
// of a motion are there for refine() to begin with.
#pragma once

#include "folded/refine.h"
#include "folded/sheet.h"
#include "folded/work.h"

namespace popup::folded {

// Moves corners by as little as makes all folds straight that pass through a corner, and all corners fold
// flat, where that fails by less than 2e-3 radians. `closes` says whether any had to be moved, none by more
// than `most_mm`, and so that keeps_panels() holds; else the sheet is as it was. Cost: a few sparse
// factorisations of as many rows as there are such folds and corners, which `work` pays for; once it is spent
// the sheet is left as it was.
Refined straighten(Sheet& sheet, double most_mm, Work& work);

}  // namespace popup::folded
