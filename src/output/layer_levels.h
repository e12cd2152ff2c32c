// Things that lie on one another, as levels.
#pragma once

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace popup {

// Of `count` things the level of each: 0 of what lies on nothing, else one more than the highest that it lies
// on. `over` has pairs of them, the lower one first. Where they lie on one another in a circle, as the flaps
// of a box can, one of them counts as the lowest. Cost: linear in things and pairs.
std::vector<int> layer_levels(std::size_t count, std::span<const std::pair<int, int>> over);

}  // namespace popup
