// Text in HTML pages.
#pragma once

#include <string>
#include <string_view>

namespace popup {

// The text as it stands between tags, or in an attribute within double quotes: markup of its own is text
// there.
std::string html_text(std::string_view text);

}  // namespace popup
