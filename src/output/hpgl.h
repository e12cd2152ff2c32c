// Cut sheets as HP-GL, for plotters and cutting plotters, one file a sheet.
#pragma once

#include <optional>
#include <vector>

#include "popup/output.h"

namespace popup {

// One plot (.plt) a sheet: IN, PA, SP, PU and PD alone, which every plotter and cutter knows. Coordinates are
// whole plotter units of 0.025 mm (1016 an inch), so no point is more than 0.018 mm off; origin at the
// sheet's lower left corner, x along its width, y up, never negative. A contour ends where it begins. Points
// that fall together are one; a line that falls into one point is left out, since it would be a prick. No
// command has more than 40 points, so that small buffers do.
//
// Each layer of the profile that lines can be in has a pen, numbered from 1 in the order of being done;
// layers of the same name share one. Numbers depend on profile and options alone, so they are the same on all
// sheets. Plotters have eight pens: where there are more layers, what is printed is all pen 1, and seven are
// left for folds and cuts, which are no more kinds than that.
//
// Areas of colour and texts are left out; letters are drawn, as outlines, where the profile outlines texts.
// Folds are whole lines, whatever is dashed for the eye. Speed and force are the machine's. A cutter that
// does not tell pens apart cuts all there is, printed lines too: its profile leaves those out, or what is
// printed has a file of its own (print_and_cut).
//
// Remark: `plotter-range`, of lines beyond 32767 units (819 mm), the most that plotters of the first HP-GL
// take. Later ones take more, so the sheet is written as it is. Cost: linear in lines.
std::optional<std::vector<SheetFile>> write_hpgl(const Layout& layout, const OutputOptions& options,
                                                 Diagnostics& diagnostics);

}  // namespace popup
