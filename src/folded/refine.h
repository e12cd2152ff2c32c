// Corners moved by the rounding of a drawing, so that the loops of a sheet close.
//
// Loops that hang together have more conditions than folds, and what is drawn to three decimals fulfils them
// to three decimals: folds that should be parallel are nearly so, and strictly the sheet is rigid. So the
// loops are closed at several shares of the final angles at once, with the places of corners as unknowns
// beside the angles; corners are dear, so that they move only where angles do not help.
#pragma once

#include <vector>

#include "folded/path.h"
#include "folded/sheet.h"
#include "folded/work.h"

namespace popup::folded {

struct Refined {
    bool closes = false;  // else the sheet is as it was
    double most_mm = 0.0;
    int corner = -1;  // that moved furthest
    int moved = 0;    // how many moved by more than 1e-6 mm
};

// Moves corners of the folds by `most_mm` at most, so that all stretches of a fold lie on one line and all
// loops close at each of some shares. `paths` are how the sheet went without: where they lead the search
// begins. Cost: a few sparse factorisations of as many rows as all loops have conditions at all those shares,
// which `work` pays for; once it is spent the sheet is left as it was.
Refined refine(Sheet& sheet, const Paths& paths, double most_mm, Work& work);

// The remark `corners-refined`, if any corner moved by more than 1e-4 mm. `sheet` has their new places.
void tell(const Refined& refined, const CreasePattern& pattern, const Sheet& sheet, Diagnostics& diagnostics);

// Whether panels and folds are still there with their corners in these places: each panel the right way
// round, with a thousandth of its area at least, and each stretch of a fold with as much of its length; and
// no edges cross.
bool keeps_panels(const Sheet& sheet, const std::vector<Vec2>& corners);

// Gives the corners of a sheet new places.
void move_corners(Sheet& sheet, std::vector<Vec2> corners);

// Whether a fold has corners that do not lie on its line, to 1e-9 mm.
bool has_bent_folds(const Sheet& sheet);

}  // namespace popup::folded
