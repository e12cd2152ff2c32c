// Colours as people and programs have written them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "popup/print.h"

namespace popup {

// "#rgb", "#rrggbb", "r,g,b" with whole numbers from 0 to 255, a CSS colour name, or the signed 32-bit ARGB
// number that Java's Color.getRGB() gives (-65536 is red; its alpha is disregarded). Case and blanks around
// do not matter. nullopt when it is none of these.
std::optional<Color> parse_color(std::string_view text);

// The names of CSS colours, sorted.
std::vector<std::string_view> color_names();

// The CSS colour name nearest to a misspelt one; empty when none is near.
std::string nearest_color_name(std::string_view text);

}  // namespace popup
