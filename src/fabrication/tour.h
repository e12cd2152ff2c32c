// The order in which a machine follows lines, and where it begins each: little way between them.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "popup/geometry.h"

namespace popup {

// A line or contour to be followed once. Open: from either end. Closed: round from any of its corners.
struct Stop {
    std::span<const Vec2> corners;  // at least one; open: the two ends at least
    bool closed = false;
};

struct Visit {
    std::size_t stop = 0;
    bool reversed = false;   // open: from its last corner to its first
    std::size_t corner = 0;  // closed: where it begins and ends
};

// Visits every stop once: from `from` always to the nearest, then made shorter by 2-opt (Croes 1958) over
// near neighbours until no exchange it looks at helps. Never longer than by nearest neighbours, where
// contours have at most 64 corners; of those with more only so many are looked at. The same stops in the same
// order give the same tour. Cost: O(n log n) for n corners, and at most a thousand steps an exchange.
std::vector<Visit> tour(std::span<const Stop> stops, Vec2 from);

// The way between stops when they are visited like that, the way from `from` included.
double way_between(std::span<const Stop> stops, std::span<const Visit> visits, Vec2 from);

}  // namespace popup
