#include "input/drawing/transform.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <span>
#include <string>
#include <utility>

#include "base/text/number_scanner.h"
#include "input/drawing/size.h"
#include "input/text.h"

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

// A number of a function, in user units or degrees; nullopt when its unit is another.
std::optional<double> argument(std::string_view function, NumberScanner& scanner) {
    const auto number = scanner.number();
    const std::string_view rest = scanner.rest();
    const auto* const end = std::find_if_not(rest.begin(), rest.end(), [](char c) {
        return c == '%' || ((c | 0x20) >= 'a' && (c | 0x20) <= 'z');
    });
    const std::string unit = number ? lower(std::string_view(rest.begin(), end)) : "";
    if (unit.empty()) return number;
    scanner.skip(unit.size());
    if (function.starts_with("translate") && unit != "%")
        return parse_length("1" + unit, 0.0).value_or(NAN) * *number;
    if (!function.starts_with("rotate") && !function.starts_with("skew")) return std::nullopt;
    return degrees_of(*number, unit);
}

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
    if (name == "translateX" && v.size() == 1) return Affine{1.0, 0.0, 0.0, 1.0, v[0], 0.0};
    if (name == "translateY" && v.size() == 1) return Affine{1.0, 0.0, 0.0, 1.0, 0.0, v[0]};
    if (name == "translateZ" && v.size() == 1 && v[0] == 0.0) return Affine{};
    if (name == "translate3d" && v.size() == 3 && v[2] == 0.0) return Affine{1.0, 0.0, 0.0, 1.0, v[0], v[1]};
    if (name == "scaleX" && v.size() == 1) return Affine{v[0], 0.0, 0.0, 1.0, 0.0, 0.0};
    if (name == "scaleY" && v.size() == 1) return Affine{1.0, 0.0, 0.0, v[0], 0.0, 0.0};
    if (name == "skew" && (v.size() == 1 || v.size() == 2))
        return Affine{1.0, v.size() == 2 ? skew(v[1]) : 0.0, skew(v[0]), 1.0, 0.0, 0.0};
    if (name == "skewX" && v.size() == 1) return Affine{1.0, 0.0, skew(v[0]), 1.0, 0.0, 0.0};
    if (name == "skewY" && v.size() == 1) return Affine{1.0, skew(v[0]), 0.0, 1.0, 0.0, 0.0};
    return std::nullopt;
}

}  // namespace

Affine Affine::after(const Affine& inner) const {
    return {a * inner.a + c * inner.b, b * inner.a + d * inner.b,     a * inner.c + c * inner.d,
            b * inner.c + d * inner.d, a * inner.e + c * inner.f + e, b * inner.e + d * inner.f + f};
}

std::optional<double> degrees_of(double number, std::string_view unit) {
    if (unit == "deg") return number;
    if (unit == "grad") return 0.9 * number;
    if (unit == "rad") return number * 180.0 / std::numbers::pi;
    return unit == "turn" ? std::optional(360.0 * number) : std::nullopt;
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
        if (rest.substr(length).starts_with("3d")) length += 2;
        const std::string_view name = rest.substr(0, length);
        scanner.skip(length);
        if (scanner.peek() != '(') return std::nullopt;
        scanner.skip(1);
        std::array<double, 6> values{};
        std::size_t count = 0;
        while (scanner.peek() != ')') {
            const auto number = argument(name, scanner);
            if (!number || std::isnan(*number) || count == values.size()) return std::nullopt;
            values.at(count++) = *number;
        }
        scanner.skip(1);
        const auto next = one_transform(name, std::span(values).first(count));
        if (!next) return std::nullopt;
        all = all.after(*next);
    }
    return all;
}

std::optional<Vec2> parse_origin(std::string_view text, Vec2 view) {
    std::array<std::string, 2> words;  // what follows them is a depth
    std::size_t count = 0;
    for (text = trimmed(text); !text.empty() && count < 2; text = trimmed(text)) {
        const std::size_t end = std::min(text.find_first_of(" \t\r\n,"), text.size());
        words.at(count++) = lower(text.substr(0, end));
        text = trimmed(text.substr(end));
        if (text.starts_with(',')) text.remove_prefix(1);
    }
    if (count == 0) return std::nullopt;
    if (count == 1) words[1] = "center";
    const auto is_side = [](const std::string& word) { return word == "left" || word == "right"; };
    const auto is_end = [](const std::string& word) { return word == "top" || word == "bottom"; };
    if (is_end(words[0]) || is_side(words[1])) std::swap(words[0], words[1]);
    if (is_end(words[0]) || is_side(words[1])) return std::nullopt;
    const auto along = [](const std::string& word, double whole) -> std::optional<double> {
        if (word == "center") return 0.5 * whole;
        if (word == "left" || word == "top") return 0.0;
        return word == "right" || word == "bottom" ? std::optional(whole) : parse_length(word, whole);
    };
    const auto x = along(words[0], view.x);
    const auto y = along(words[1], view.y);
    return x && y ? std::optional(Vec2{*x, *y}) : std::nullopt;
}

}  // namespace popup::drawing
