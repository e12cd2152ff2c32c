// Text as it is set, from left to right.
#pragma once

#include <string>
#include <string_view>

namespace popup {

// The characters of a line in the order in which they stand on paper, from left to right, by the Unicode
// Bidirectional Algorithm; its direction is that of its first letter. Arabic letters are the ones that join
// with their neighbours (presentation forms), and brackets are mirrored where that is needed. What draws
// letters one after another needs it; a browser that is given a text does all that itself. Text without
// letters of scripts that run to the left is given back as it is. Cost: linear.
// Precondition: valid UTF-8.
std::string in_visual_order(std::string_view text);

}  // namespace popup
