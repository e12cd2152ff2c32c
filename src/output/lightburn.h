// Cut sheets as LightBurn projects, one project a sheet.
#pragma once

#include <optional>
#include <vector>

#include "popup/output.h"

namespace popup {

// One project (.lbrn2, FormatVersion 1) a sheet: lines in mm, origin at the sheet's lower left corner, y up,
// six decimals at most. Well-formed whatever the names.
//
// What is folded and cut has a cut setting for each layer of the profile that lines of the sheet are in;
// where pens of one layer differ in colour, speed or power, for each of these. It has the layer's name, its
// place in the order of being done (priority), and speed (mm/s) and power (%) where the profile knows them:
// minPower is maxPower then. What is not known is left to LightBurn.
//
// LightBurn tells layers apart by colour, and knows thirty, numbered: `index`. A setting has the number of
// its pen's colour; where that is none of the thirty, or belongs to a setting before it, the nearest (in RGB)
// that no setting has. The numbers depend on the profile alone, so they are the same on all sheets of a run.
//
// What is printed, letters as their outlines, is on the tool layer T1 (index 30), which LightBurn shows and
// never sends to the machine; areas of colour are left out. Folds are whole lines, whatever is dashed for the
// eye.
//
// Shapes are paths of lines and Bézier curves, one a run, in the order of the drawing (sheet_drawing.h).
// LightBurn keeps to the order of layers; within a layer its own optimization settings decide. Errors: those
// of views_of(). Cost: linear in lines.
//
// LightBurn publishes its palette, but no description of the format: this is what projects that it wrote, and
// programs that read them, have in common. Each shape has a VertID and a PrimID of its own, since LightBurn
// takes lists of the same number for one list.
std::optional<std::vector<SheetFile>> write_lightburn(const Layout& layout, const OutputOptions& options,
                                                      Diagnostics& diagnostics);

}  // namespace popup
