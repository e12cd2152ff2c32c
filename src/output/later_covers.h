// Which prints may be hidden by which: what spares looking at each pair of them.
#pragma once

#include <span>
#include <vector>

#include "popup/geometry.h"

namespace popup {

struct PaintedBox {
    Box box;
    bool covers = true;  // hides what is below it
};

// For each box the numbers of the later ones that cover and meet it, ascending. Cost: near linear in boxes
// and in pairs that meet.
std::vector<std::vector<int>> later_covers(std::span<const PaintedBox> boxes);

}  // namespace popup
