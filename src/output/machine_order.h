// What a machine follows, in the order in which it does so.
#pragma once

#include "output/sheet_drawing.h"

namespace popup {

// Of a drawing whose pieces have been drawn: cuts know their depth on the sheet, and what lies in another
// piece's hole is an inner cut; points too close for a machine are one; what lies on a line cut before it is
// taken away; and the lines of each operation and depth stand in a tour, deeper ones first. What is printed
// stays as it is. Cost: near linear in points.
void put_in_machine_order(SheetDrawing& drawing);

}  // namespace popup
