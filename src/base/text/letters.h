// What a font makes of a line of text: how long it is, and which of its letters the font has.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/font_file.h"

namespace popup {

// A font that stays open for its thread: FreeType is not to be used from two at once. Null: it cannot be
// read.
const FontFile* open_font(TextFont font);

struct Letters {
    double length_mm = 0.0;
    // Characters that the font has no letter for, which are printed as boxes; each once, in their order.
    std::vector<std::string> missing;
};

// Of a line of text with capitals `cap_mm` high; nullopt when the font cannot be read. As text_outlines(): no
// kerning. Cost: linear in letters; the font is read once a thread.
std::optional<Letters> measure_letters(std::string_view text, double cap_mm, TextFont font);

// Whether every font has all of it for certain, so that none needs to be opened: printable ASCII.
bool is_plain(std::string_view text);

}  // namespace popup
