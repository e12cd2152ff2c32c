// The opening cut into ranges of angles, and which plates come near each other in each.
#pragma once

#include <span>
#include <vector>

#include "base/geometry/near_boxes.h"
#include "motion/pair_search.h"
#include "motion/sweep.h"

namespace popup {

// Ends of the ranges, from the least opening to the end of the sweep. Near a flat closed state distances are
// as the angle to it, so each range there is as wide as what lies below it. `range_ends`, ascending, are
// ends as well (Linkage::range_ends()).
std::vector<double> cell_ends(const Sweep& sweep, std::span<const double> range_ends);

// Places everything; false when a linkage does not reach one of the three angles.
bool fill_cell(const Assembly& assembly, const Linkage& linkage, double from, double to, Cell& cell);

// The same for some joints, with all that they stand on, in order, and the turns of these. What the cell says
// of others means nothing.
bool fill_cell(const Assembly& assembly, const Linkage& linkage, std::span<const std::size_t> joints,
               double from, double to, Cell& cell);

// By plate: boxes round all that its corners can reach in the cell, and half of `distance_mm` beyond it.
// Cost: plates × depth of their mechanism.
std::vector<SpaceBox> reach_boxes(const Cell& cell, const Linkage& linkage,
                                  std::span<const PlateShape> shapes, double distance_mm);
// The same of some corners of the page of one plate, whose joint the cell is filled for; if no turn has a
// law.
SpaceBox reach_box(const Cell& cell, const Linkage& linkage, int plate, std::span<const Vec2> corners,
                   double distance_mm);

}  // namespace popup
