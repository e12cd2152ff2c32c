#include "input/xml/units.h"

#include <fmt/format.h>

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

// The first unit in which a longer side of that many units is that of a card to hold in the hands; null:
// none.
const Unit* likely_unit(double longer) {
    constexpr double kLeastHeldMm = 60.0;
    constexpr double kMostHeldMm = 700.0;
    for (const UnitRow& row : kUnits) {
        const double mm = longer * row.unit.mm;
        if (mm >= kLeastHeldMm && mm <= kMostHeldMm) return &row.unit;
    }
    return nullptr;
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

void doubt_page_size(double width_mm, double height_mm, const Unit& unit, Place place, Reporter& reporter) {
    constexpr double kLargestLikelyMm = 1200.0;
    constexpr double kSmallestLikelyMm = 30.0;
    const double longer = std::max(width_mm, height_mm);
    if (longer >= kSmallestLikelyMm && longer <= kLargestLikelyMm) return;
    const auto size_in = [&](const Unit& named) {
        return fmt::format("{} × {} {}", format_number(width_mm / unit.mm),
                           format_number(height_mm / unit.mm), named.name);
    };
    const double m = longer / 1000.0;
    Diagnostic& made =
        reporter.warning("page-size-unlikely", place,
                         fmt::format("the open card is {}, {}", size_in(unit),
                                     m > 1.0 ? fmt::format("{:.2f} m on its longer side", m)
                                             : fmt::format("{:.2f} mm on its longer side", longer)));
    const Unit* likely = likely_unit(longer / unit.mm);
    if (likely != nullptr && likely->name != unit.name)
        made.hint(fmt::format("units=\"{}\" in <popup> would make it {}", likely->name, size_in(*likely)));
}

}  // namespace popup::xml
