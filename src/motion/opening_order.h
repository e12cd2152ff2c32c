// Which folds of a sheet are tried first where it is opened, so that it is folded as people fold it.
#pragma once

#include <span>
#include <vector>

#include "popup/assembly.h"

namespace popup {

// Folds that only go together.
struct OrderedPart {
    std::vector<int> joints;  // ascending
    double area = 0.0;        // of what it moves, mm²
};

enum class OpenFirst {
    lids,   // the lid of a tray with what hangs on it, then as `small`
    small,  // flaps before the walls that they hang on
    large,  // those that move the most
};

// What a part does to the lid of a tray, which name_panels() calls so.
enum class OfLid { no, hangs_on, closes };
OfLid of_lid(const Assembly& assembly, const OrderedPart& part);

// The numbers of the parts, those that are tried first in front. Of parts that move as much, as the flaps of
// a square box do, those about parallel lines come together, for the flaps of opposite walls go in one step;
// first those about the lines of the first of them, which hangs nearest to the panel that stays. Then as they
// are numbered. `closed` are the frames of the plates where all is folded.
std::vector<int> opening_order(const Assembly& assembly, std::span<const OrderedPart> parts,
                               std::span<const Frame> closed, OpenFirst first);

}  // namespace popup
