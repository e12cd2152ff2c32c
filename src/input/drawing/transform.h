// Affine maps, and the transform attribute.
#pragma once

#include <cmath>
#include <optional>
#include <string_view>

#include "popup/geometry.h"

namespace popup::drawing {

// p ↦ (a x + c y + e, b x + d y + f), as SVG's matrix(a b c d e f).
struct Affine {
    double a = 1.0, b = 0.0, c = 0.0, d = 1.0, e = 0.0, f = 0.0;

    [[nodiscard]] Vec2 operator()(Vec2 p) const { return {a * p.x + c * p.y + e, b * p.x + d * p.y + f}; }
    // First `inner`, then this.
    [[nodiscard]] Affine after(const Affine& inner) const;
    // How much lengths grow, on average over all directions.
    [[nodiscard]] double growth() const { return std::sqrt(std::abs(a * d - b * c)); }
};

// A list of matrix, translate, scale, rotate, skewX and skewY; the first is done last. Nullopt when the text
// is anything else. Values may be infinite.
std::optional<Affine> parse_transform(std::string_view text);

}  // namespace popup::drawing
