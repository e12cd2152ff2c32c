#include "input/drawing/transform.h"

#include <array>
#include <cstddef>
#include <numbers>
#include <span>

#include "base/text/number_scanner.h"

namespace popup::drawing {
namespace {

// Quarter turns are exact.
Affine turn(double degrees) {
    const double quarters = degrees / 90.0;
    if (std::isfinite(quarters) && quarters == std::round(quarters)) {
        constexpr std::array<std::array<double, 2>, 4> kTurns{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
        const auto [cosine, sine] = kTurns.at(static_cast<std::size_t>(std::fmod(quarters, 4.0) + 4.0) % 4);
        return {cosine, sine, -sine, cosine, 0.0, 0.0};
    }
    const double angle = std::fmod(degrees, 360.0) * std::numbers::pi / 180.0;
    return {std::cos(angle), std::sin(angle), -std::sin(angle), std::cos(angle), 0.0, 0.0};
}

double skew(double degrees) { return std::tan(std::fmod(degrees, 180.0) * std::numbers::pi / 180.0); }

std::optional<Affine> one_transform(std::string_view name, std::span<const double> v) {
    if (name == "matrix" && v.size() == 6) return Affine{v[0], v[1], v[2], v[3], v[4], v[5]};
    if (name == "translate" && (v.size() == 1 || v.size() == 2)) {
        return Affine{1.0, 0.0, 0.0, 1.0, v[0], v.size() == 2 ? v[1] : 0.0};
    }
    if (name == "scale" && (v.size() == 1 || v.size() == 2)) {
        return Affine{v[0], 0.0, 0.0, v.size() == 2 ? v[1] : v[0], 0.0, 0.0};
    }
    if (name == "rotate" && v.size() == 1) return turn(v[0]);
    if (name == "rotate" && v.size() == 3) {
        return Affine{1, 0, 0, 1, v[1], v[2]}.after(turn(v[0])).after({1, 0, 0, 1, -v[1], -v[2]});
    }
    if (name == "skewX" && v.size() == 1) return Affine{1.0, 0.0, skew(v[0]), 1.0, 0.0, 0.0};
    if (name == "skewY" && v.size() == 1) return Affine{1.0, skew(v[0]), 0.0, 1.0, 0.0, 0.0};
    return std::nullopt;
}

}  // namespace

Affine Affine::after(const Affine& inner) const {
    return {a * inner.a + c * inner.b, b * inner.a + d * inner.b,     a * inner.c + c * inner.d,
            b * inner.c + d * inner.d, a * inner.e + c * inner.f + e, b * inner.e + d * inner.f + f};
}

std::optional<Affine> parse_transform(std::string_view text) {
    Affine all;
    NumberScanner scanner(text);
    if (scanner.peek() == 'n' && scanner.rest().starts_with("none")) return all;
    while (scanner.peek() != '\0') {
        scanner.skip_separator();
        std::size_t length = 0;
        const std::string_view rest = scanner.rest();
        while (length < rest.size() && ((rest[length] | 0x20) >= 'a' && (rest[length] | 0x20) <= 'z')) {
            ++length;
        }
        const std::string_view name = rest.substr(0, length);
        scanner.skip(length);
        if (scanner.peek() != '(') return std::nullopt;
        scanner.skip(1);
        std::array<double, 6> values{};
        std::size_t count = 0;
        while (scanner.peek() != ')') {
            const auto number = scanner.number();
            if (!number || count == values.size()) return std::nullopt;
            values.at(count++) = *number;
        }
        scanner.skip(1);
        const auto next = one_transform(name, std::span(values).first(count));
        if (!next) return std::nullopt;
        all = all.after(*next);
    }
    return all;
}

}  // namespace popup::drawing
