// The units a document may be written in.
#pragma once

#include <span>
#include <string_view>

#include "popup/design.h"

namespace popup::xml {

struct UnitRow {
    Unit unit;
    std::string_view others;  // what else it is called, separated by blanks, in lower case
};
// The first is the default.
std::span<const UnitRow> unit_table();
// The unit of that name, case disregarded, or null.
const Unit* find_unit(std::string_view name);
// The unit at the end of a text such as "200 mm" or "8in", behind a number; null: it has none.
const Unit* unit_behind_number(std::string_view text);

// Open cards are seldom larger or smaller than this, on their longer side.
inline constexpr double kLargestLikelyMm = 1200.0;
inline constexpr double kSmallestLikelyMm = 30.0;
// The first unit in which a longer side of that many units is that of a card to hold in the hands, from 60 to
// 700 mm; null: none is.
const Unit* likely_unit(double longer);

}  // namespace popup::xml
