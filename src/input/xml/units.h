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

}  // namespace popup::xml
