// The opening cut into ranges of angles, and which plates come near each other in each.
#pragma once

#include <utility>
#include <vector>

#include "motion/pair_search.h"
#include "motion/sweep.h"

namespace popup {

// Ends of the ranges, from the least opening to the end of the sweep. Near a flat closed state distances are
// as the angle to it, so each range there is as wide as what lies below it. `range_ends`, ascending, are
// ends as well (Linkage::range_ends()).
std::vector<double> cell_ends(const Sweep& sweep, std::span<const double> range_ends);

// Places everything; false when a linkage does not reach one of the three angles.
bool fill_cell(const Assembly& assembly, const Linkage& linkage, double from, double to, Cell& cell);

// Pairs (a, b), a < b, in order, whose plates may come within `distance_mm` of each other in the cell: boxes
// round all that their corners can reach touch. Ends early after more than `most`. Cost: plates × depth of
// their mechanism, n log n, pairs.
std::vector<std::pair<int, int>> near_pairs(const Cell& cell, const Linkage& linkage,
                                            std::span<const PlateShape> shapes, double distance_mm,
                                            std::size_t most);

}  // namespace popup
