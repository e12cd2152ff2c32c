// The opening cut into ranges of angles, and which plates come near each other in each.
#pragma once

#include <utility>
#include <vector>

#include "motion/pair_search.h"

namespace popup {

// The smallest opening angle looked at. A card of 100 mm is open by less than 0.02 mm there.
inline constexpr double kLeastOpeningDeg = 0.01;

// Ends of the ranges, from kLeastOpeningDeg to 180. Distances are as the angle is near 0°, so each range
// there is as wide as what lies below it.
std::vector<double> cell_ends();

// Places everything; false when a linkage does not reach one of the three angles.
bool fill_cell(const Assembly& assembly, const Linkage& linkage, double from, double to, Cell& cell);

// Pairs (a, b), a < b, in order, whose plates may come within `distance_mm` of each other in the cell: boxes
// round all that their corners can reach touch. Ends early after more than `most`. Cost: plates × depth of
// their mechanism, n log n, pairs.
std::vector<std::pair<int, int>> near_pairs(const Cell& cell, const Linkage& linkage,
                                            std::span<const PlateShape> shapes, double distance_mm,
                                            std::size_t most);

}  // namespace popup
