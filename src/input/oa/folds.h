// Where the regions of a sheet are folded to each other, and what hangs together.
#pragma once

#include <vector>

#include "input/oa/sheet.h"

namespace popup::oa {

// A line along the gutter where two regions of the sheet meet in the card, too: what stands at depth d and
// what lies at height h do so at x = d - h.
struct Fold {
    int above = -1, below = -1;  // regions: on the side of the back (x below that of the fold), of the floor
    double x = 0.0, y0 = 0.0, y1 = 0.0;  // y0 < y1
    bool valley = false;                 // what stands is above, and stands on what lies; else it carries it
};

// All of at least kTouchMm, by x and y. Cost: near linear in corners.
std::vector<Fold> folds_between(const std::vector<Region>& regions);

// What holds the regions.
struct Holding {
    // The covers: of the parts of back and of floor those that the gutter joins, or the largest. -1: there is
    // no paper left of it.
    int back = -1, floor = -1;
    struct Step {
        int region = -1;
        int fold = -1;  // to one before it; -1: a cover
    };
    std::vector<Step> order;  // what folds lead to from the covers, nearest first
    std::vector<bool> held;   // by region
};
Holding holding(const std::vector<Region>& regions, const std::vector<Fold>& folds);

}  // namespace popup::oa
