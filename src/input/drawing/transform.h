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
    friend bool operator==(const Affine&, const Affine&) = default;
};

// Degrees of an angle with a unit of CSS: deg, grad, rad or turn. Nullopt of any other unit.
std::optional<double> degrees_of(double number, std::string_view unit);

// A list of matrix, translate, scale, rotate, skewX and skewY, and of what CSS has beside these: translateX,
// translateY, translateZ(0), translate3d(1px, 2px, 0), scaleX, scaleY and skew, and units of lengths and
// angles. The first is done last. Nullopt when the text is anything else. Values may be infinite.
std::optional<Affine> parse_transform(std::string_view text);

// About which point a transform is done: lengths, shares of `view` in percent, or left, right, top, bottom
// and center. One that is missing is the middle (CSS Transforms 1, 8). Nullopt when it is none.
std::optional<Vec2> parse_origin(std::string_view text, Vec2 view);

}  // namespace popup::drawing
