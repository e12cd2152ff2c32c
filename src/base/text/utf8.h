// Text as characters.
#pragma once

#include <cstddef>
#include <string_view>

namespace popup {

struct Character {
    char32_t code = 0;
    std::size_t bytes = 1;
    bool valid = true;
};

// Decodes the character at the front of UTF-8. A byte that begins no valid sequence is a character of its
// own, its value the code. Precondition: the text is not empty.
Character first_character(std::string_view text);

// The text without the byte order mark that some editors put before UTF-8.
constexpr std::string_view without_mark(std::string_view text) {
    constexpr std::string_view kMark = "\xEF\xBB\xBF";
    return text.starts_with(kMark) ? text.substr(kMark.size()) : text;
}

}  // namespace popup
