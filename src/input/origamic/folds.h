// An origamic architecture: a card of one sheet of which all that moves stays parallel to its back or to its
// floor. Where the regions of the sheet are folded to each other, and what hangs together.
//
// The open card (90°) has the back at depth 0 and the floor at height 0. On the sheet x runs over the gutter
// from back (x < 0) to floor, y along it. In each line across the gutter the sheet goes down and forwards by
// turns, so a point x of it has depth - height = x. What stands at depth d therefore has its points at the
// height d - x, what lies at height h at the depth x + h.
//
//     const std::vector<Fold> folds = folds_between(regions);
//     const Holding held = holding(regions, folds);
#pragma once

#include <vector>

#include "popup/geometry.h"

namespace popup::origamic {

// A connected part of the sheet in one plane.
struct Region {
    bool upright = false;  // parallel to the back, else to the floor
    double offset = 0.0;   // its depth, or its height; 0 of back and floor
    Polygon area;
    bool of_cover = false;  // a part of the back or of the floor
};

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

}  // namespace popup::origamic
