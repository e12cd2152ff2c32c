// An element moved along what it stands on, in the design as it is written.
#pragma once

#include "popup/design.h"
#include "popup/motion.h"

namespace popup {

struct Footings;  // mechanism/footings.h

// How far the move goes as it is written: rounded up to a hundredth of a millimetre.
double moved_mm(const FreeingMove& move);

// Moves the element, and what stands on what it takes along: of a cut element all that is built on it, of a
// glued one what stands on its seams, while what stands on its own piece stays there. Marks what has changed,
// for Language::patch. Lines and pictures that are printed on the page stay. False, and nothing is changed:
// there is no such element, or the fold that it stands on is not known. Cost: linear in structures.
//
//     Design design = *compiled.design;
//     if (move_element(design, footings_of(design), motion.moves.front()))
//         text = language.patch(source, design);
bool move_element(Design& design, const Footings& standing, const FreeingMove& move);

}  // namespace popup
