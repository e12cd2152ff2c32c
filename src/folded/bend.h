// Where panels bend when a sheet cannot be folded with flat ones.
//
// Paper bends more readily than it stretches: a panel of four corners that is twisted bends along a diagonal.
// A sheet whose panels are divided into triangles can nearly always be folded, so that what is drawn can be
// seen, near to the angles that it asks for, and where its panels would bend, and by how much.
#pragma once

#include <vector>

#include "folded/path.h"
#include "folded/sheet.h"
#include "folded/work.h"

namespace popup::folded {

// A sheet that folds with panels that bend, and how it goes.
struct Bent {
    Sheet sheet;  // triangles in place of the panels that bend
    Paths paths;
};

// Divides the panels beside loops that do not leave the flat sheet, and finds the paths again. `sheet` is the
// pattern's as make_sheet() gives it, and `paths` its paths. Lines that the pattern draws as flat are taken
// where they lead from corner to corner of a panel; what is left is divided into triangles with angles as
// wide as can be. Returns nullopt if there is nothing to divide, if a loop does not leave the flat sheet
// nevertheless, or if `work` is spent.
std::optional<Bent> bend_panels(const CreasePattern& pattern, const FoldOptions& options, const Sheet& sheet,
                                const Paths& paths, Work& work);

}  // namespace popup::folded
