// Points of an element that its author gave in each other's places.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "popup/design.h"
#include "popup/mechanism.h"

namespace popup {

// Two points of a row, by their numbers, that change places.
using Exchange = std::pair<std::size_t, std::size_t>;

// The fewest exchanges, at most two, after which `makes_sense` holds of the structure; of as many, the first
// in the row's order. Empty: none does, or the row has fewer than two points. Points of the fold's page
// change places among themselves only, and so do those of the piece. Cost: `makes_sense` is asked at most 28
// times for one exchange of eight points, and 378 times for two.
std::vector<Exchange> exchanges_that_help(const ElementInfo& info, const Structure& structure,
                                          const std::function<bool(const Structure&)>& makes_sense);

// In words: "A with B", "A with B, then G with H".
std::string to_text(const std::vector<Exchange>& exchanges, const ElementInfo& info);

}  // namespace popup
