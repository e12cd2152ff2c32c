#include "input/xml/reference.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>

namespace popup::xml {
namespace {

// The longest reference that is looked at; longer ones are no references.
constexpr std::size_t kLongest = 32;
constexpr std::size_t kLongestNumber = 12;  // "&#x0010FFFF;"

std::size_t utf8_length(std::uint32_t c) { return c < 0x80 ? 1 : c < 0x800 ? 2 : c < 0x10000 ? 3 : 4; }

// The Char production of XML 1.0.
bool is_allowed(std::uint32_t c) {
    return c == 0x9 || c == 0xa || c == 0xd || (c >= 0x20 && c <= 0xd7ff) || (c >= 0xe000 && c <= 0xfffd) ||
           (c >= 0x10000 && c <= 0x10ffff);
}

}  // namespace

Reference read_reference(std::string_view text) {
    using Fault = Reference::Fault;
    const std::size_t semicolon = text.substr(0, kLongest).find(';');
    if (semicolon == std::string_view::npos || semicolon < 2) return {Fault::no_reference, 1, 0};
    const std::size_t length = semicolon + 1;
    std::string_view name = text.substr(1, semicolon - 1);
    if (name.front() != '#') {
        constexpr std::array<std::string_view, 5> kEntities{"amp", "apos", "gt", "lt", "quot"};
        if (std::find(kEntities.begin(), kEntities.end(), name) != kEntities.end())
            return {Fault::none, length, 1};
        const bool is_name = name.find_first_of(" \t\r\n<>&\"'=") == std::string_view::npos;
        return {is_name ? Fault::unknown_entity : Fault::no_reference, length, 0};
    }
    name.remove_prefix(1);
    const bool hexadecimal = name.starts_with('x');
    if (hexadecimal) name.remove_prefix(1);
    std::uint32_t c = 0;
    const auto [stop, error] =
        std::from_chars(name.data(), name.data() + name.size(), c, hexadecimal ? 16 : 10);
    if (length > kLongestNumber || name.empty() || error == std::errc::invalid_argument ||
        stop != name.data() + name.size()) {
        return {Fault::no_reference, length, 0};
    }
    if (error != std::errc{} || !is_allowed(c)) return {Fault::forbidden_character, length, 0};
    return {Fault::none, length, utf8_length(c)};
}

}  // namespace popup::xml
