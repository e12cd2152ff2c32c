// Bytes as text, and back.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace popup {

// The bytes in base 64 (RFC 4648), with padding, on one line.
std::string base64(std::string_view bytes);
// The bytes of such a text, blanks and line breaks in it disregarded. nullopt: it is not one.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace popup
