// Corners of flaps that are glued to the panel beside the flap, as those of a crash-lock bottom, or of a tray
// that is sold glued and flat: no drawing says that the oblique creases before them lie flat when the box
// stands.
#pragma once

#include "folded/sheet.h"
#include "popup/crease_pattern.h"

namespace popup::folded {

// A crease across a flap at the end of a row of walls, from where the flap's own fold and the fold to the
// next wall meet, at 17° to 73° to either; beyond it is a corner of the flap that hangs on nothing else, and
// the next wall has a flap there, too, to which it is glued. Such a crease folds the corner over while the
// tube is flat. Where neither the pattern nor the options say how far it goes, it lies flat in the end. Told:
// the remark `glue-corners`. Cost: linear in folds.
void lay_glue_corners(const CreasePattern& pattern, const FoldOptions& options, Sheet& sheet,
                      Diagnostics& diagnostics);

}  // namespace popup::folded
