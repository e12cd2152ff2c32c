// JSON as the program writes it.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace popup {

// The value with two spaces of indentation and a final line break; an array of nothing but numbers, strings
// and the like stands on one line, so that a point is "[1.5, 2.0]". Invalid UTF-8 is replaced. Precondition:
// the value is one the program made (its depth is that of the format, not of a document).
std::string json_text(const nlohmann::ordered_json& value);

// The value as json_text() has it `depth` levels down in another: lines after the first are indented for
// there, and there is no final line break.
std::string json_text_within(const nlohmann::ordered_json& value, std::size_t depth);

}  // namespace popup
