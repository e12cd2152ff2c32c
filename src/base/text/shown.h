// Texts of others in messages.
#pragma once

#include <string>
#include <string_view>

namespace popup {

// At most 40 characters of a text, one line, cut off with "..." between characters.
std::string shown(std::string_view text);

}  // namespace popup
