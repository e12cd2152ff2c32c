// Letters as outlines, for programs that have no font, or another one.
#pragma once

#include <string_view>
#include <vector>

#include "popup/geometry.h"
#include "popup/print.h"

namespace popup {

// Whether the font can be read.
bool can_outline_text(TextFont font = TextFont::sans);

// The outlines of a line of text, to be filled by the non-zero rule: its middle at `at` (half
// its length, half the height of its capitals), capitals `cap_mm` high, turned counter-clockwise by `angle`
// (radians). Curves are polygons that keep within 0.5 % of cap_mm. Kerning is left out. Nothing when the font
// cannot be read. Cost: linear in letters; the font is read once a thread. Precondition: valid UTF-8.
std::vector<Ring> text_outlines(std::string_view text, Vec2 at, double cap_mm, double angle,
                                TextFont font = TextFont::sans);

}  // namespace popup
