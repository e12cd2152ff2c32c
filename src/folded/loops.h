// The loops of a sheet's folds, read from its planar graph.
#pragma once

#include <vector>

#include "folded/sheet.h"

namespace popup::folded {

// What the halves of a graph are for the folds of a sheet.
struct HalfFolds {
    std::vector<int> fold;      // by edge: its fold, -1 for none
    std::vector<int> panel_of;  // by face: -1 for what is no paper
};

// All loops but those that follow from others: one around each inner corner and each hole of a piece. Where
// two folds of a loop are crossed there and back at once they are left out of it. Cost: linear in edges.
std::vector<Loop> find_loops(const SheetGraph& graph, const HalfFolds& halves, const std::vector<Fold>& folds,
                             const std::vector<Panel>& panels);

}  // namespace popup::folded
