// What lies flat on a plate and reaches across a fold of it.
//
// Such a plate has only the line of the fold in common with the paper on the other side of it, at every
// angle: no two of the three cross. And yet it goes through the paper where that turns to the side that it
// lies on: in front of it while the fold is flat, behind it once it is folded.
#pragma once

#include <vector>

#include "popup/assembly.h"

namespace popup {

struct AcrossFold {
    int plate = 0;       // what lies flat
    int on = 0;          // the plate that has the fold, or on which a seam stands
    int through = 0;     // the plate on the other side of the fold, or that stands on the seam
    Segment at;          // the longest stretch where it reaches across, on the page of `on`
    double by_mm = 0.0;  // how far it reaches over paper beyond a fold
    bool seam = false;   // it is turned by hand, and what is glued there is in the way
};

// By plate, at most one for each other plate. What is turned by hand reaches as far as at any of its turns;
// what is glued to the same side of the plate, on its way, is told of too. A stretch counts from 0.02 mm of
// the fold, with paper on either side of it; what ends at the fold does not reach across. Cost: near linear
// in plates that lie flat, and in the folds and seams that each comes near; three placements where there is
// such a plate.
std::vector<AcrossFold> find_across_folds(const Assembly& assembly);

}  // namespace popup
