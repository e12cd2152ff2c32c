// Text in XML and HTML.
#pragma once

#include <string>
#include <string_view>

namespace popup {

// The text as it stands between tags, or in an attribute within double quotes: markup of its own is text
// there.
std::string as_markup(std::string_view text);

// The same of text that may come from a document: what cannot be seen is made visible.
std::string told_html(std::string_view text);

}  // namespace popup
