// Small questions about words of a document.
#pragma once

#include <string>
#include <string_view>

#include "base/text/shown.h"  // IWYU pragma: export

namespace popup {

constexpr bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

// Without XML's blanks at either end.
std::string_view trimmed(std::string_view text);

// Can be an element's id: [A-Za-z_][A-Za-z0-9_.-]*
bool is_id(std::string_view text);
// What the base page is called; no element has it as its id.
inline constexpr std::string_view kBasePage = "page";
inline constexpr std::string_view kIdHint =
    "an id begins with a letter from A to Z or a to z, or \"_\", and goes on with such letters, digits, "
    "\"_\", "
    "\".\" and \"-\"";

// Whether it is UTF-16 or UTF-32, by its byte order mark or by the zero bytes beside its first character.
// None of the languages is written so.
bool is_wide_text(std::string_view text);

// With ASCII letters in lower case.
std::string lower(std::string_view text);

// At most 80 bytes of a name without the blanks around it, whole characters.
std::string short_name(std::string_view name);

}  // namespace popup
