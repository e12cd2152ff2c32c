// The opening cut into ranges of angles, and which plates come near each other in each.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
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

// The same for some joints, with all that they stand on, in order, and the turns of these. What the cell says
// of others means nothing.
bool fill_cell(const Assembly& assembly, const Linkage& linkage, std::span<const std::size_t> joints,
               double from, double to, Cell& cell);

struct SpaceBox {
    Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL};
    Vec3 high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};

    // Makes it hold a point, and all within `reach` mm of it.
    void extend(Vec3 p, double reach = 0.0) {
        low = {std::min(low.x, p.x - reach), std::min(low.y, p.y - reach), std::min(low.z, p.z - reach)};
        high = {std::max(high.x, p.x + reach), std::max(high.y, p.y + reach), std::max(high.z, p.z + reach)};
    }
    [[nodiscard]] bool meets(const SpaceBox& other) const {
        return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y &&
               other.low.y <= high.y && low.z <= other.high.z && other.low.z <= high.z;
    }
    [[nodiscard]] SpaceBox grown(double mm) const {
        return {{low.x - mm, low.y - mm, low.z - mm}, {high.x + mm, high.y + mm, high.z + mm}};
    }
};

// By plate: boxes round all that its corners can reach in the cell, and half of `distance_mm` beyond it.
// Cost: plates × depth of their mechanism.
std::vector<SpaceBox> reach_boxes(const Cell& cell, const Linkage& linkage,
                                  std::span<const PlateShape> shapes, double distance_mm);
// The same of some corners of the page of one plate, whose joint the cell is filled for; if no turn has a
// law.
SpaceBox reach_box(const Cell& cell, const Linkage& linkage, int plate, std::span<const Vec2> corners,
                   double distance_mm);

// Pairs (a, b), a < b, in order, whose boxes touch: those plates may come near each other. Ends early after
// more than `most`. Cost: n log n, pairs.
std::vector<std::pair<int, int>> near_pairs(std::span<const SpaceBox> boxes, std::size_t most);
// The same with at most `most_each` earlier plates to each, whatever heaps others lie in.
std::vector<std::pair<int, int>> near_earlier(std::span<const SpaceBox> boxes, std::size_t most_each);

}  // namespace popup
