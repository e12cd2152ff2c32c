// What a sheet has besides its pieces: registration marks, and a bar to measure.
#pragma once

#include <vector>

#include "popup/geometry.h"
#include "popup/profile.h"

namespace popup {

struct SheetMark {
    std::vector<Vec2> points;
    bool closed = false;
    bool filled = false;
};

// The marks of a sheet of this size, as seen from the side that is worked on: a machine looks for them in the
// same places on a front and on a back. They stay within clear_of(marks) of the edges.
std::vector<SheetMark> registration_marks(Marks marks, double width_mm, double height_mm);

// A bar with ticks at its ends, exactly this long from tick to tick, in the lower margin, and where the
// middle of its figure stands. The margin counts as kReferenceMarginMm at least, which is what bar and figure
// need.
struct ReferenceBar {
    std::vector<SheetMark> lines;
    Vec2 figure_at;
};
ReferenceBar reference_bar(double length_mm, double width_mm, double margin_mm);
inline constexpr double kReferenceMarginMm = 5.0;
inline constexpr double kFigureMm = 2.0;  // height of the figure
// The longest bar that a sheet of this width has room for, its figure and the marks included.
double longest_reference(double width_mm);

}  // namespace popup
