// Text as lines that a machine follows.
#pragma once

#include <string_view>
#include <vector>

#include "popup/geometry.h"

namespace popup {

struct StrokedLine {
    std::vector<Vec2> points;
    bool closed = false;
};

// The lines of a text in letters of single lines, its middle at `at` (half its length, half the height of its
// capitals), turned counter-clockwise by `angle` in radians. Characters that fabrication/stroke_font.h does
// not have are drawn as outlines of DejaVu Sans, or as boxes where that font is missing. Precondition: valid
// UTF-8.
std::vector<StrokedLine> stroked_text(std::string_view text, Vec2 at, double cap_mm, double angle);

}  // namespace popup
