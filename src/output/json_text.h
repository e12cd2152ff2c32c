// JSON as the program writes it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace popup {

// The value with two spaces of indentation and a final line break; an array of nothing but numbers, strings
// and the like stands on one line, so that a point is "[1.5, 2.0]". Invalid UTF-8 is replaced. Precondition:
// the value is one the program made (its depth is that of the format, not of a document).
std::string json_text(const nlohmann::ordered_json& value);

}  // namespace popup
