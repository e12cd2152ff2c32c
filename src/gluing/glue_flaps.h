// Flaps of folded sheets that are glued, which no number tells of: panels that are called so, and bottoms of
// bags.
#pragma once

#include <vector>

#include "popup/assembly.h"

namespace popup {

struct GlueFlap {
    int flap = -1;       // plate
    int panel = -1;      // that it lies on in the folded sheet; -1: none is near it
    bool inside = true;  // on the side of the panel that looks to the middle of the folded sheet
    // By index into folding_steps(): after which it lies there for good; the last where none is near.
    int step = 0;
};

// Of a folded sheet, by plate:
//
// * every panel with "glue-flap" or "glue-corner" in its name, and what it lies on at the end: parallel, its
//   middle within the panel and at most 10.5 mm off, the nearest of those that it does not hang on;
// * of bags, which are what has walls that a crease parts ("left-1" and "left-2"), every flap of an end that
//   lies so on another flap of that end; of two that lie on each other that which comes there last, else the
//   first.
//
// On which side is told by the distance between them, or where there is none by the side that it comes from.
// None of what moves not, or is no folded sheet. Cost: the poses of folding_steps(), and flaps times plates.
std::vector<GlueFlap> glue_flaps(const Assembly& assembly);

}  // namespace popup
