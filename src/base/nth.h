// Elements by their numbers, which are ints or enumerators where values name one another.
#pragma once

#include <cstddef>
#include <type_traits>

namespace popup {

// The element of `items` with this number, which counts from 0: nth(layout.designs, placement.design). It
// costs what items[] costs, and checks as much. Precondition: 0 ≤ number < items.size().
template <class Items, class Number>
requires(std::is_integral_v<Number> || std::is_enum_v<Number>) [[nodiscard]] constexpr decltype(auto)
    nth(Items& items, Number number) {
    return items[static_cast<std::size_t>(number)];
}

}  // namespace popup
