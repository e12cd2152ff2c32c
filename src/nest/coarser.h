// Regions with fewer corners, which only grow.
#pragma once

#include <cstddef>
#include <cstdint>

#include "nest/convex_parts.h"

namespace popup {

// How a region is made coarser.
struct Coarsening {
    double most_added = 0.0;  // area that may be gained, steps squared
    double furthest = 0.0;    // no new corner lies further than this many steps from an old edge
    // New corners lie on the edges they meet in, or outside of them: the region is inside the new one to the
    // last step. Else they are rounded to the grid, and an edge may end up one step inside of where it was.
    bool encloses = false;
    // Bays whose mouth is no wider, in steps, are filled at first, whatever they gain.
    double narrow = 0.0;
    // While more corners than `many` are left, this area may be gained; it is no less than `most_added`.
    double most_added_of_many = 0.0;
    std::size_t many = SIZE_MAX;
};

// The region with corners taken away so that it only grows: notches filled, and short edges replaced by the
// corner in which their neighbours meet, the least area first, until what may be gained would be exceeded.
// What grows may grow over itself, but with `encloses`. Cost: n log n in corners, where they are not crowded.
GridRegion coarser(const GridRegion& region, const Coarsening& how);

}  // namespace popup
