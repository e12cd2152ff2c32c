// Colours as text, the way this program writes them.
#include <fmt/format.h>

#include <charconv>

#include "popup/print.h"

namespace popup {

std::string to_string(Color color) { return fmt::format("#{:02x}{:02x}{:02x}", color.r, color.g, color.b); }

std::optional<Color> hex_color(std::string_view text) {
    if (text.size() != 7 || text.front() != '#') return std::nullopt;
    std::uint32_t rgb = 0;
    const char* end = text.data() + text.size();
    const auto [read, error] = std::from_chars(text.data() + 1, end, rgb, 16);
    if (error != std::errc() || read != end) return std::nullopt;
    return Color{static_cast<std::uint8_t>(rgb >> 16), static_cast<std::uint8_t>(rgb >> 8 & 0xFFU),
                 static_cast<std::uint8_t>(rgb & 0xFFU)};
}

}  // namespace popup
