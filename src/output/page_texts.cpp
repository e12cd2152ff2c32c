#include "output/page_texts.h"

#include <algorithm>
#include <numbers>

#include "base/text/visual_order.h"
#include "output/sheet_drawing.h"

namespace popup {
namespace {

void set_size(cairo_t* context, double cap_mm) { cairo_set_font_size(context, cap_mm / kCapHeight); }

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

std::vector<std::string> wrapped(cairo_t* context, std::string_view text, double cap_mm, double room_mm) {
    std::vector<std::string> lines;
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t to = std::min(text.find(' ', from), text.size());
        const std::string word(text.substr(from, to - from));
        from = to + 1;
        if (!lines.empty()) {
            const std::string longer = lines.back() + " " + word;
            if (text_length(context, longer, cap_mm) <= room_mm) {
                lines.back() = longer;
                continue;
            }
        }
        lines.push_back(word);
    }
    return lines;
}

}  // namespace popup
