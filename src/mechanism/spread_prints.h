// What authors draw and print, given to the plates and pieces that it lies on.
#pragma once

#include "mechanism/builder.h"
#include "popup/assembly.h"
#include "popup/design.h"
#include "popup/diagnostics.h"

namespace popup {

// The same on the page's mirror image, x to -x: it lies where its mirror image would, but pictures and texts
// are not turned over.
void mirror(DrawnPrint& print);

// Areas, pictures and drawn lines go to the plates of their page whose paper they meet, texts to the piece.
// Pictures with a horizon go to all plates of their page, for level_horizons() to choose from; once there are
// a million copies, only to those that they meet as they are drawn. `drawn-off-page`: of a line, an area or a
// picture that meets no paper, and of a text that is beside all of it. Precondition: outlines are final;
// every page is there. Cost: near linear in plates and in what is printed, and in those copies.
void spread_prints(const Skeleton& skeleton, const Design& design, const AssembleOptions& options,
                   Assembly& assembly, Diagnostics& diagnostics);

}  // namespace popup
