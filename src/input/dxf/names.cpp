#include "input/dxf/names.h"

#include <array>
#include <charconv>
#include <cstdint>
#include <optional>

#include "base/text/utf8.h"

namespace popup::dxf {
namespace {

constexpr char32_t kUnknown = 0xfffd;
// Of ANSI_1252 from 0x80 to 0x9f; the rest is Latin-1.
constexpr std::array<char32_t, 32> kLatin{
    0x20ac, kUnknown, 0x201a,   0x0192, 0x201e,   0x2026,   0x2020, 0x2021,   0x02c6, 0x2030, 0x0160,
    0x2039, 0x0152,   kUnknown, 0x017d, kUnknown, kUnknown, 0x2018, 0x2019,   0x201c, 0x201d, 0x2022,
    0x2013, 0x2014,   0x02dc,   0x2122, 0x0161,   0x203a,   0x0153, kUnknown, 0x017e, 0x0178};

void append(char32_t code, std::string& to) {
    const auto byte = [&to](char32_t value) { to += static_cast<char>(static_cast<unsigned char>(value)); };
    if (code < 0x80U) return byte(code < 0x20U || code == 0x7fU ? U' ' : code);
    if (code < 0x800U) {
        byte(0xc0U | (code >> 6U));
    } else {
        if (code < 0x10000U) {
            byte(0xe0U | (code >> 12U));
        } else {
            byte(0xf0U | (code >> 18U));
            byte(0x80U | ((code >> 12U) & 0x3fU));
        }
        byte(0x80U | ((code >> 6U) & 0x3fU));
    }
    byte(0x80U | (code & 0x3fU));
}

// "\U+00E9" at the front.
std::optional<std::uint32_t> escaped(std::string_view text) {
    constexpr std::size_t kLength = 7;
    if (!text.starts_with("\\U+") || text.size() < kLength) return std::nullopt;
    std::uint32_t code = 0;
    const auto [stop, error] = std::from_chars(text.data() + 3, text.data() + kLength, code, 16);
    return error == std::errc{} && stop == text.data() + kLength ? std::optional(code) : std::nullopt;
}

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const Character character = first_character(text);
        if (!character.valid) return false;
        text.remove_prefix(character.bytes);
    }
    return true;
}

}  // namespace

void Names::take_version(std::string_view acadver) {
    // Of 2007 and later, "AC1021".
    utf8_ = acadver.size() == 6 && acadver >= "AC1021";
}

void Names::take_code_page(std::string_view page) { latin_ = page == "ANSI_1252" || page == "ansi_1252"; }

std::string Names::decoded(std::string_view name) const {
    const bool utf8 = utf8_ || is_utf8(name);
    std::string made;
    while (!name.empty()) {
        if (auto code = escaped(name)) {
            name.remove_prefix(7);
            // UTF-16 has two for those beyond the first plane.
            const auto low = *code >= 0xd800U && *code < 0xdc00U ? escaped(name) : std::nullopt;
            if (low && *low >= 0xdc00U && *low < 0xe000U) {
                name.remove_prefix(7);
                code = 0x10000U + ((*code - 0xd800U) << 10U) + (*low - 0xdc00U);
            }
            append(*code >= 0xd800U && *code < 0xe000U ? kUnknown : static_cast<char32_t>(*code), made);
            continue;
        }
        const Character character = first_character(name);
        if (utf8 || character.code < 0x80U) {
            append(character.valid ? character.code : kUnknown, made);
            name.remove_prefix(character.bytes);
            continue;
        }
        const auto byte = static_cast<unsigned char>(name.front());
        append(!latin_ ? kUnknown : byte < 0xa0U ? kLatin.at(byte - 0x80U) : char32_t{byte}, made);
        name.remove_prefix(1);
    }
    return made;
}

}  // namespace popup::dxf
