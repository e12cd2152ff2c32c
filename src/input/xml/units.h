// The units a document may be written in.
#pragma once

#include <span>
#include <string_view>

#include "input/xml/fields.h"
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

// Warns of an open card of over 1.2 m or under 30 mm on its longer side, as a unit that was forgotten makes
// it: `page-size-unlikely`, with the first unit in which it would be one to hold in the hands, from 60 to 700
// mm.
void doubt_page_size(double width_mm, double height_mm, const Unit& unit, Place place, Reporter& reporter);

}  // namespace popup::xml
