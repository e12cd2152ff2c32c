#include "base/text/letters.h"

#include <algorithm>
#include <array>
#include <memory>
#include <set>

#include "base/text/cap_height.h"
#include "base/text/utf8.h"
#include "base/text/visual_order.h"

namespace popup {
namespace {

// Unicode's marks that have no letter of their own: joiners and signs of direction and of variants.
bool is_unseen(char32_t code) {
    return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0xAD ||
           (code >= 0x200B && code <= 0x200F) || (code >= 0x202A && code <= 0x202E) ||
           (code >= 0x2060 && code <= 0x206F) || (code >= 0xFE00 && code <= 0xFE0F) || code == 0xFEFF;
}

template <typename Visit>
void each_letter(std::string_view text, const Visit& visit) {
    while (!text.empty()) {
        const Character letter = first_character(text);
        visit(letter, text.substr(0, letter.bytes));
        text.remove_prefix(letter.bytes);
    }
}

}  // namespace

const FontFile* open_font(TextFont font) {
    struct Slot {
        bool opened = false;
        std::unique_ptr<FontFile> file;
    };
    thread_local std::array<Slot, kTextFontNames.size()> slots;
    Slot& slot = slots.at(static_cast<std::size_t>(font));
    if (!slot.opened) slot = {true, FontFile::open(font_path(font))};
    return slot.file.get();
}

std::optional<Letters> measure_letters(std::string_view text, double cap_mm, TextFont font) {
    const FontFile* file = open_font(font);
    if (file == nullptr) return std::nullopt;
    Letters letters;
    std::set<char32_t> missing;
    // As it is written, for that is how it is told.
    each_letter(text, [&](const Character& letter, std::string_view written) {
        if (FT_Get_Char_Index(file->face, letter.code) == 0 && !is_unseen(letter.code) &&
            missing.insert(letter.code).second)
            letters.missing.emplace_back(written);
    });
    const bool has_all = missing.empty();
    double units = 0.0;
    each_letter(in_visual_order(text), [&](const Character& letter, std::string_view written) {
        const FT_UInt glyph = FT_Get_Char_Index(file->face, letter.code);
        // A font may have a letter, and not the form in which it joins with others.
        if (has_all && glyph == 0 && !is_unseen(letter.code) && missing.insert(letter.code).second)
            letters.missing.emplace_back(written);
        if (FT_Load_Glyph(file->face, glyph, FT_LOAD_NO_SCALE) != 0) return;
        units += static_cast<double>(file->face->glyph->metrics.horiAdvance);
    });
    letters.length_mm = units * cap_mm / (kCapHeight * file->face->units_per_EM);
    return letters;
}

bool is_plain(std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
}

}  // namespace popup
