// What stands on what in a design as it is written, before anything is checked: for who shows designs, or
// changes them.
//
//     const Footings footings = footings_of(design);
//     const int fold = footings.ground[3].fold;  // that of the fourth structure stands on
//     if (fold >= 0) fmt::print("{} of {}", footings.folds[fold].name, footings.folds[fold].owner);
#pragma once

#include <string_view>
#include <vector>

#include "popup/design.h"
#include "popup/mechanism.h"

namespace popup {

// A fold or seam of a design.
struct StandingFold {
    int owner = -1;         // number of the structure that makes it; -1: it is the gutter
    std::string_view name;  // as its row calls it; "gutter"
    PageFold at;
};

struct Ground {
    int fold = -1;          // number of the fold that it stands on
    bool reversed = false;  // it names that fold from its end to its begin
    int plate_owner = -1;   // of an element on a plate of an element's piece: the number of that
    int extra_page = -1;    // of its own piece; -1: it has none
    // The number of the structure that it stands on; -1: the page, or it is not known.
    int owner = -1;
};

struct Footings {
    std::vector<StandingFold> folds;  // the gutter first, then in build order
    std::vector<Ground> ground;       // of each structure
};

// Folds are found by their names or by their lines, to 0.5 mm; of several the youngest. A structure whose
// fold is not found, whose type is not known, that has another number of points than its row, or whose points
// lie beside a named fold other than the gutter, makes no folds. Cost: linear in structures, and in those
// that share a page.
Footings footings_of(const Design& design);

// The direction, of length 1, in which a structure on that fold would move along it on its left and its right
// page, seen as the structure names the fold.
Vec2 along_left(const StandingFold& fold, bool reversed);
Vec2 along_right(const StandingFold& fold, bool reversed);

}  // namespace popup
