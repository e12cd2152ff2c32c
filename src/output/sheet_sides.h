// What of a sheet is on which side of it, and in which file.
#pragma once

#include "output/sheet_drawing.h"

namespace popup {

// Whether the view shows what is done like that. Marks are in every view that has a pen for them; what is
// printed on its front, or on both sides where backs are wanted, notes on how to glue on the back alone then;
// what the machine does is on the side it works from.
bool is_shown(Operation operation, const OutputOptions& options, const SheetView& view);

// Whether sheets show, printed or marked, what is glued to the backs of plates.
bool are_backs_marked(const OutputOptions& options);

// The profile by which the view is drawn. What is printed has a file of its own under print_and_cut, and the
// machine's pens have no say in that one: what they leave out is drawn as the profile workshop does.
Profile profile_of(const OutputOptions& options, const SheetView& view);

}  // namespace popup
