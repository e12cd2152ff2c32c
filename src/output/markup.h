// Text in XML and HTML.
#pragma once

#include <string>
#include <string_view>

namespace popup {

// The text as it stands between tags, or in an attribute within double quotes: markup of its own is text
// there.
std::string as_markup(std::string_view text);

}  // namespace popup
