// Letters of single lines, for what a machine draws without filling it.
#pragma once

#include <vector>

#include "popup/geometry.h"

namespace popup {

// A letter whose capitals are 1 high: its lines, with the origin at the left end of its base line, and how
// far to the right the next letter begins.
struct StrokeLetter {
    std::vector<std::vector<Vec2>> lines;  // of at least two points each; a space has none
    double advance = 0.0;
};

// Whether the font has the character; it has those of ASCII that are printed.
bool has_stroke_letter(char32_t character);
// Precondition: it has the character.
StrokeLetter stroke_letter(char32_t character);

}  // namespace popup
