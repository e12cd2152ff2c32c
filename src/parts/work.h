// How much work an input may be. Booleans and indexes are near linear for drawings that people make; for
// others their cost grows with the square, and it is estimated before they are asked.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "base/geometry/edge_index.h"
#include "popup/geometry.h"

namespace popup {

// The work left for one input. Each question takes what it allows, and is false once there is too little.
class Work {
 public:
    // For a boolean or offset of these rings: its cost is for each corner the number of edges at its height.
    bool sweep(std::span<const Ring* const> rings);
    bool sweep(const Ring& ring);
    bool sweep(const std::vector<Polygon>& regions);
    // For looking at all edges of `index` near each of these.
    bool crossings(const EdgeIndex& index, std::span<const Segment> segments);
    // For as many looks at single edges or corners.
    bool looks(std::size_t count);

 private:
    std::size_t sweeps_left_ = 400'000'000;
    std::size_t crossings_left_ = 20'000'000;
    std::size_t looks_left_ = 300'000'000;
};

}  // namespace popup
