#include "output/stroked_text.h"

#include <algorithm>
#include <cmath>

#include "base/text/utf8.h"
#include "base/text/visual_order.h"
#include "fabrication/stroke_font.h"
#include "output/text_outlines.h"

namespace popup {
namespace {

// Of capitals 1 high: the lines of one character, from `right` on, and how wide it is.
double add_outlines(std::string_view character, double right, std::vector<StrokedLine>& lines) {
    constexpr double kBeside = 0.1;
    std::vector<Ring> rings = text_outlines(character, {0.0, 0.5}, 1.0, 0.0, TextFont::sans);
    if (rings.empty()) rings = {{{0.0, 0.0}, {0.6, 0.0}, {0.6, 1.0}, {0.0, 1.0}}};
    Box box;
    for (const Ring& ring : rings) {
        for (const Vec2 p : ring) box.extend(p);
    }
    for (Ring& ring : rings) {
        for (Vec2& p : ring) p.x += right + kBeside - box.min.x;
        lines.push_back({std::move(ring), true});
    }
    return box.width() + 2.0 * kBeside;
}

}  // namespace

std::vector<StrokedLine> stroked_text(std::string_view text, Vec2 at, double cap_mm, double angle) {
    const std::string set = in_visual_order(text);
    text = set;
    std::vector<StrokedLine> lines;
    double right = 0.0;
    while (!text.empty()) {
        const Character one = first_character(text);
        if (has_stroke_letter(one.code)) {
            StrokeLetter letter = stroke_letter(one.code);
            for (std::vector<Vec2>& line : letter.lines) {
                for (Vec2& p : line) p.x += right;
                lines.push_back({std::move(line), false});
            }
            right += letter.advance;
        } else {
            right += add_outlines(text.substr(0, one.bytes), right, lines);
        }
        text.remove_prefix(one.bytes);
    }
    const Vec2 x{cap_mm * std::cos(angle), cap_mm * std::sin(angle)};
    const Vec2 y{-x.y, x.x};
    for (StrokedLine& line : lines) {
        for (Vec2& p : line.points) p = at + (p.x - 0.5 * right) * x + (p.y - 0.5) * y;
    }
    return lines;
}

}  // namespace popup
