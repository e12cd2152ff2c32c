#include "input/drawing/label.h"

#include <cmath>
#include <vector>

#include "input/text.h"
#include "popup/path.h"

namespace popup::drawing {
namespace {

constexpr double kCapHeight = 1493.0 / 2048.0;  // of DejaVu Sans' capitals, of its font size

}  // namespace

std::optional<Text> label_of(const xml::Node& element, const Attributes& attributes, const Affine& to_mm) {
    std::optional<ShapeProblem> problem;
    const double x = length_of(attributes, "x", 0.0, HUGE_VAL, problem);
    const double y = length_of(attributes, "y", 0.0, HUGE_VAL, problem);
    const double size = length_of(attributes, "font-size", 0.0, 0.0, problem);
    if (problem) return std::nullopt;
    const std::vector<xml::Text> words = element.texts();
    const double cap = kCapHeight * size;
    const Vec2 at = to_mm({x, y - 0.5 * cap});
    const Vec2 along = to_mm({x + 1.0, y - 0.5 * cap}) - at;
    const double height = cap * length(along);
    const bool sound = std::abs(at.x) <= kReachMm && std::abs(at.y) <= kReachMm && height > 0.0 &&
                       height <= kReachMm && words.size() == 1;
    if (!sound) return std::nullopt;
    return Text{short_name(words[0].decoded), at, height, std::atan2(along.y, along.x)};
}

}  // namespace popup::drawing
