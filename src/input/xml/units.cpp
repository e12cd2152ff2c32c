#include "input/xml/units.h"

#include <algorithm>
#include <array>
#include <string>

#include "input/text.h"
#include "input/xml/number.h"

namespace popup::xml {
namespace {

constexpr double kInch = 25.4;
constexpr std::array kUnits = std::to_array<UnitRow>({
    {{"in", kInch}, "inch inches"},
    {{"mm", 1.0}, "millimetre millimetres millimeter millimeters"},
    {{"cm", 10.0}, "centimetre centimetres centimeter centimeters"},
    {{"pt", kInch / 72.0}, "point points"},
    {{"px", kInch / 72.0}, "pixel pixels"},  // Java's user space: 72 an inch
});

bool has_word(std::string_view words, std::string_view word) {
    while (!words.empty()) {
        const std::size_t blank = std::min(words.find(' '), words.size());
        if (words.substr(0, blank) == word) return true;
        words.remove_prefix(std::min(blank + 1, words.size()));
    }
    return false;
}

}  // namespace

std::span<const UnitRow> unit_table() { return kUnits; }

const Unit* find_unit(std::string_view name) {
    const std::string word = lower(name);
    for (const UnitRow& row : kUnits) {
        if (word == row.unit.name || has_word(row.others, word)) return &row.unit;
    }
    return nullptr;
}

const Unit* unit_behind_number(std::string_view text) {
    text = trimmed(text);
    const std::size_t digit = text.find_last_of("0123456789.");
    if (digit == std::string_view::npos || parse_number(text.substr(0, digit + 1)).fault != NumberFault::none)
        return nullptr;
    return find_unit(trimmed(text.substr(digit + 1)));
}

const Unit* likely_unit(double longer) {
    constexpr double kLeastHeldMm = 60.0;
    constexpr double kMostHeldMm = 700.0;
    for (const UnitRow& row : kUnits) {
        const double mm = longer * row.unit.mm;
        if (mm >= kLeastHeldMm && mm <= kMostHeldMm) return &row.unit;
    }
    return nullptr;
}

}  // namespace popup::xml
