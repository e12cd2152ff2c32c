#include "output/page_texts.h"

#include <algorithm>
#include <numbers>

#include "base/text/visual_order.h"
#include "output/sheet_drawing.h"

namespace popup {
namespace {

void set_size(cairo_t* context, double cap_mm) { cairo_set_font_size(context, cap_mm / kCapHeight); }

bool begins_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }

}  // namespace

void grey(cairo_t* context, double white) { cairo_set_source_rgb(context, white, white, white); }

double text_length(cairo_t* context, std::string_view text, double cap_mm) {
    set_size(context, cap_mm);
    cairo_text_extents_t extents{};
    cairo_text_extents(context, in_visual_order(text).c_str(), &extents);
    return extents.x_advance;
}

void write(cairo_t* context, std::string_view text, Vec2 at, double cap_mm) {
    write_from(context, text, {at.x - 0.5 * text_length(context, text, cap_mm), at.y + 0.5 * cap_mm}, cap_mm);
}

void write_fitting(cairo_t* context, std::string_view text, Vec2 at, double cap_mm, double room_mm) {
    const double length = text_length(context, text, cap_mm);
    write(context, text, at, length > room_mm ? cap_mm * room_mm / length : cap_mm);
}

void write_turned(cairo_t* context, std::string_view text, Vec2 at, double cap_mm) {
    cairo_save(context);
    cairo_translate(context, at.x, at.y);
    cairo_rotate(context, -0.5 * std::numbers::pi);
    write(context, text, {}, cap_mm);
    cairo_restore(context);
}

void write_from(cairo_t* context, std::string_view text, Vec2 at, double cap_mm) {
    set_size(context, cap_mm);
    cairo_move_to(context, at.x, at.y);
    cairo_show_text(context, in_visual_order(text).c_str());
    cairo_new_path(context);
}

namespace {

// How many bytes of a word have room: all, else those up to behind the last "-", "_", "." or "/" that has,
// else as many characters as have; never none.
std::size_t bytes_with_room(cairo_t* context, std::string_view word, double cap_mm, double room_mm) {
    constexpr std::size_t kLongest = 400;  // no line holds more, and a word may be as long as a document
    if (word.size() <= kLongest && text_length(context, word, cap_mm) <= room_mm) return word.size();
    std::size_t most = 0;
    std::size_t at_mark = 0;
    for (std::size_t end = 1; end <= std::min(word.size(), kLongest); ++end) {
        if (end < word.size() && !begins_character(word[end])) continue;
        if (most > 0 && text_length(context, word.substr(0, end), cap_mm) > room_mm) break;
        most = end;
        if (std::string_view("-_./").find(word[end - 1]) != std::string_view::npos) at_mark = end;
    }
    return at_mark > 0 ? at_mark : most;
}

}  // namespace

std::vector<std::string> wrapped(cairo_t* context, std::string_view text, double cap_mm, double room_mm) {
    std::vector<std::string> lines;
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t to = std::min(text.find(' ', from), text.size());
        std::string_view word = text.substr(from, to - from);
        from = to + 1;
        if (!lines.empty()) {
            const std::string longer = lines.back() + " " + std::string(word);
            if (text_length(context, longer, cap_mm) <= room_mm) {
                lines.back() = longer;
                continue;
            }
        }
        do {
            const std::size_t some = bytes_with_room(context, word, cap_mm, room_mm);
            lines.emplace_back(word.substr(0, some));
            word.remove_prefix(some);
        } while (!word.empty());
    }
    return lines;
}

}  // namespace popup
