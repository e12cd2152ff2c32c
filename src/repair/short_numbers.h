// Repaired numbers as people would write them: -74, where the search for a repair came to -74.000046.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "popup/design.h"

namespace popup {

// How many decimals a length needs in this unit to stand for a place to half a hundredth of a millimetre: 2
// in millimetres, 4 in inches.
int short_decimals(const Unit& unit);
// As many as documents have at most.
inline constexpr int kMostDecimals = 6;

// By the id of an element: how many decimals its changed lengths get. An element that is not named gets
// short_decimals().
using DecimalsOf = std::map<std::string, int, std::less<>>;

// Rounds the lengths of structures that differ from what is written in `text`, which the design was read
// from, in the document's unit: points, folds, plates and arguments. What stays as it is written keeps its
// digits.
void shorten_numbers(Design& design, std::string_view text, const DecimalsOf& decimals);

}  // namespace popup
