// Rings that neither cross nor touch each other or themselves: what they enclose is known without clipping.
//
// A clipper looks at every edge that is level with each corner; a sweep looks at the two beside it. So a
// drawing of many corners, almost always simple, costs n log n however many of its edges lie above each
// other.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace popup {

// A corner on an integer grid, within ±2^60.
struct GridPoint {
    std::int64_t x = 0, y = 0;
    bool operator==(const GridPoint&) const = default;
};
using GridRing = std::vector<GridPoint>;

// The ring without doubled corners and corners in the middle of a straight edge; empty when none has an area.
// Spikes stay.
GridRing without_straight_corners(const GridRing& ring);

// Whether each ring lies within an odd number of others: it is a hole where they are painted together by the
// even-odd rule. nullopt: two edges have a point in common other than the corner between neighbours. Exact.
// Precondition: rings from without_straight_corners(). Cost: n log n in corners. The algorithm is the sweep
// of M. I. Shamos and D. Hoey, "Geometric intersection problems" (1976).
std::optional<std::vector<bool>> holes_of_simple_rings(const std::vector<GridRing>& rings);

}  // namespace popup
