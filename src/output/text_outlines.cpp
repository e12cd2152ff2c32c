#include "output/text_outlines.h"

#include <algorithm>
#include <cmath>

#include "base/text/letters.h"
#include FT_OUTLINE_H

#include "base/text/utf8.h"
#include "base/text/visual_order.h"
#include "output/sheet_drawing.h"

namespace popup {
namespace {

// In font units; the capitals of DejaVu fonts are 1493 of them high.
constexpr double kFlatUnits = 7.0;

struct Tracing {
    std::vector<Ring> rings;
    double right = 0.0;  // where the letter begins

    [[nodiscard]] Vec2 point(const FT_Vector* p) const {
        return {right + static_cast<double>(p->x), static_cast<double>(p->y)};
    }
    // Points of a curve whose second difference is at most `bend` long.
    static int steps(double bend) {
        return std::clamp(static_cast<int>(std::ceil(std::sqrt(bend / (4.0 * kFlatUnits)))), 1, 64);
    }
};

int move_to(const FT_Vector* to, void* user) {
    auto& tracing = *static_cast<Tracing*>(user);
    tracing.rings.push_back({tracing.point(to)});
    return 0;
}

int line_to(const FT_Vector* to, void* user) {
    auto& tracing = *static_cast<Tracing*>(user);
    tracing.rings.back().push_back(tracing.point(to));
    return 0;
}

int conic_to(const FT_Vector* control, const FT_Vector* to, void* user) {
    auto& tracing = *static_cast<Tracing*>(user);
    Ring& ring = tracing.rings.back();
    const Vec2 a = ring.back();
    const Vec2 b = tracing.point(control);
    const Vec2 c = tracing.point(to);
    const int steps = Tracing::steps(length(a - 2.0 * b + c));
    for (int i = 1; i <= steps; ++i) {
        const double t = static_cast<double>(i) / steps;
        const double u = 1.0 - t;
        ring.push_back(u * u * a + 2.0 * u * t * b + t * t * c);
    }
    return 0;
}

int cubic_to(const FT_Vector* one, const FT_Vector* two, const FT_Vector* to, void* user) {
    auto& tracing = *static_cast<Tracing*>(user);
    Ring& ring = tracing.rings.back();
    const Vec2 a = ring.back();
    const Vec2 b = tracing.point(one);
    const Vec2 c = tracing.point(two);
    const Vec2 d = tracing.point(to);
    const int steps = Tracing::steps(3.0 * std::max(length(a - 2.0 * b + c), length(b - 2.0 * c + d)));
    for (int i = 1; i <= steps; ++i) {
        const double t = static_cast<double>(i) / steps;
        const double u = 1.0 - t;
        ring.push_back(u * u * u * a + 3.0 * u * u * t * b + 3.0 * u * t * t * c + t * t * t * d);
    }
    return 0;
}

}  // namespace

bool can_outline_text(TextFont font) { return open_font(font) != nullptr; }

std::vector<Ring> text_outlines(std::string_view text, Vec2 at, double cap_mm, double angle, TextFont font) {
    const FontFile* file = open_font(font);
    if (file == nullptr) return {};
    const std::string set = in_visual_order(text);
    text = set;
    Tracing tracing;
    FT_Outline_Funcs tracers{move_to, line_to, conic_to, cubic_to, 0, 0};
    while (!text.empty()) {
        const Character letter = first_character(text);
        text.remove_prefix(letter.bytes);
        const FT_UInt glyph = FT_Get_Char_Index(file->face, letter.code);
        if (FT_Load_Glyph(file->face, glyph, FT_LOAD_NO_SCALE) != 0) continue;
        FT_Outline_Decompose(&file->face->glyph->outline, &tracers, &tracing);
        tracing.right += static_cast<double>(file->face->glyph->metrics.horiAdvance);
    }
    const double scale = cap_mm / (kCapHeight * file->face->units_per_EM);
    const Vec2 x{scale * std::cos(angle), scale * std::sin(angle)};
    const Vec2 y{-x.y, x.x};
    const double cap_units = kCapHeight * file->face->units_per_EM;
    for (Ring& ring : tracing.rings) {
        // FreeType closes contours by going back to where they began.
        if (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
        for (Vec2& p : ring) p = at + (p.x - 0.5 * tracing.right) * x + (p.y - 0.5 * cap_units) * y;
    }
    return tracing.rings;
}

}  // namespace popup
