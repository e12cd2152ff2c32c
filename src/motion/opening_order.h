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
    lids,   // parts of the lid, then of the bottom, then of the walls; each as `small`
    small,  // flaps before the walls that they hang on
    large,  // those that move the most
};

// A box is closed in this order: its walls stand, then its bottom is closed, and its lid when it is full.
enum class BoxPart { walls, bottom, lid };
// Which a part belongs to, by the names that name_panels() gives: the lid of a tray, the top and the bottom
// of a tube. Hems are of the walls.
struct OfBox {
    BoxPart part = BoxPart::walls;
    // Whether it turns lid or bottom against the rest of the box, as dust flaps do, too; tucks and ears turn
    // against the lid that they hang on.
    bool closes = false;
};
OfBox of_box(const Assembly& assembly, const OrderedPart& part);

// By part: those that fold the lining of a wall that is rolled in over a corner which this part folds, by the
// names of the panels. They are opened before it, however much room the board has between the two.
std::vector<std::vector<int>> rolled_over_by(const Assembly& assembly, std::span<const OrderedPart> parts);

// The numbers of the parts, those that are tried first in front. Of parts that move as much, as the flaps of
// a square box do, those about parallel lines come together, for the flaps of opposite walls go in one step;
// first those about the lines of the first of them, which hangs nearest to the panel that stays. Then as they
// are numbered. `closed` are the frames of the plates where all is folded.
std::vector<int> opening_order(const Assembly& assembly, std::span<const OrderedPart> parts,
                               std::span<const Frame> closed, OpenFirst first);

}  // namespace popup
