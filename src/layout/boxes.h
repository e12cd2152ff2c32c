// Boxes on sheets: rectangle packing on an integer grid.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "layout/turns.h"

namespace popup {

struct BoxSize {
    GridLength width = 0;
    GridLength height = 0;
};

// A box that may be placed in one way, or in either of two.
struct BoxItem {
    std::array<BoxSize, 2> ways;
    int count = 1;
};

struct BoxSpot {
    int sheet = 0;
    GridLength x = 0, y = 0;
    int way = 0;
};

// Places all boxes, each at least 1 × 1, on sheets of this size; boxes of a sheet do not overlap (they may
// touch). Precondition: each box's first way fits on a sheet. Few boxes: maximal free rectangles under many
// orders and choices, the best kept (fewest sheets, then the shortest last one), and the last sheet shortened
// further. Many boxes: one pass over a bounded number of open sheets.
std::vector<BoxSpot> place_boxes(std::span<const BoxItem> items, BoxSize sheet);

}  // namespace popup
