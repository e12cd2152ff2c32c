// A sheet folded flat: where every panel comes to lie, and which panels lie on each other.
#pragma once

#include <vector>

#include "folded/flat/layers.h"
#include "folded/lower.h"
#include "folded/sheet.h"
#include "popup/assembly.h"

namespace popup::folded {

// Every fold of a piece folded by half a turn: all panels in the plane of its largest, which stays.
struct FlatState {
    std::vector<char> front_up;               // by panel
    std::vector<Frame> frames;                // by panel: where it lies in the plane z = 0
    std::vector<Polygon> outlines;            // by panel, where they lie
    std::vector<std::vector<Segment>> folds;  // by fold: where its stretches lie
    // Going around a loop must lead back. The loop that misses most, and by how much, mm; -1: there is none.
    double off_mm = 0.0;
    int off_fold = -1;
};

// Cost: linear in corners.
FlatState lay_flat(const Sheet& sheet, const Tree& tree);

// The conditions on the order of panels where they lie on each other: pieces by themselves. `near_mm` > 0:
// what lies nearer than this in the flat state is one place. nullopt if there are more than `most`
// conditions, or more crossings than a drawing has. `layers_most`: the most panels on one place. Cost: near
// linear in the lines that the panels' edges make where they lie, and in conditions: cubic in the panels on
// one place.
std::optional<Layers> order_conditions(const Sheet& sheet, const FlatState& state, double near_mm,
                                       std::size_t most, std::size_t& layers_most);

// The sheet as it lies folded flat: plates that stand in the plane z = 0, the largest panel of each piece
// where it is drawn, with the order of `layers` that was found. A fold is the mountain or valley that the
// order makes it.
Assembly stacked(const CreasePattern& pattern, const Sheet& sheet, const Tree& tree, const FlatState& state,
                 const Layers& layers, const Layers::Solution& found);

}  // namespace popup::folded
