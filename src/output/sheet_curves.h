// The curves of a sheet, drawn again where chords stand for them.
#pragma once

#include <span>

#include "output/sheet_drawing.h"

namespace popup {

// Gives the runs of cuts, areas, strokes and glue targets the curves that their designs know
// (popup/curves.h). `placements` are those of the drawing's pieces, in their order. Points stay as they are,
// and so does what has no curves. Where the profile wants machine order, closed runs begin where they did;
// others may begin at the end of a curve. Cost: near linear in points of designs that have curves.
void restore_curves(SheetDrawing& drawing, const Layout& layout, std::span<const Placement> placements,
                    bool back);

}  // namespace popup
