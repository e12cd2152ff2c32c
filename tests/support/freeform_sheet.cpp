#include "support/freeform_sheet.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "support/random.h"

namespace popup::test {
namespace {

constexpr double kPitchMm = 34.0;
constexpr std::size_t kCurves = 8;

// A feature of a row: where its middle lies, how far it reaches across the fold and along it, and how far
// away its side folds are; 0: where the outline has them.
struct Feature {
    double x, across, along, folds;
};
constexpr std::array<Feature, 4> kRow{
    {{0.0, 15.0, 14.0, 12.0}, {-12.0, 6.5, 6.0, 5.0}, {12.0, 6.5, 6.0, 5.0}, {-17.0, 3.0, 3.0, 0.0}}};

// A smooth closed curve through eight points near a rounded rectangle.
std::string outline_of(const Feature& feature, double y, Random& random) {
    std::array<Vec2, kCurves> at;
    for (std::size_t i = 0; i < kCurves; ++i) {
        const double turn =
            2.0 * std::numbers::pi * static_cast<double>(i) / kCurves + 0.2 * (random.unit() - 0.5);
        const double grown = 1.0 + 0.03 * (random.unit() - 0.5);
        const auto rounded = [](double value) { return std::copysign(std::sqrt(std::abs(value)), value); };
        at.at(i) = {feature.x + grown * feature.across * rounded(std::cos(turn)),
                    y + grown * feature.along * rounded(std::sin(turn))};
    }
    return smooth_path(at);
}

}  // namespace

std::string smooth_path(std::span<const Vec2> at) {
    std::string d = fmt::format("M {:.3f} {:.3f}", at[0].x, at[0].y);
    for (std::size_t i = 0; i < at.size(); ++i) {
        const Vec2 from = at[i];
        const Vec2 to = at[(i + 1) % at.size()];
        const Vec2 c = from + 1.0 / 6.0 * (to - at[(i + at.size() - 1) % at.size()]);
        const Vec2 e = to - 1.0 / 6.0 * (at[(i + 2) % at.size()] - from);
        d += fmt::format(" C {:.3f} {:.3f} {:.3f} {:.3f} {:.3f} {:.3f}", c.x, c.y, e.x, e.y, to.x, to.y);
    }
    return d + " Z";
}

std::string freeform_sheet(int features) {
    const int rows = (features + static_cast<int>(kRow.size()) - 1) / static_cast<int>(kRow.size());
    const double height = kPitchMm * rows + 20.0;
    Random random(5);
    std::string text = fmt::format(
        "<popup version='3.0' units='mm'>\n<mainpage width='120' height='{}'/>\n<structurelist>\n", height);
    for (int i = 0; i < features; ++i) {
        const Feature& feature = kRow.at(static_cast<std::size_t>(i) % kRow.size());
        const double y =
            kPitchMm * (0.5 + static_cast<double>(i / static_cast<int>(kRow.size()))) + 10.0 - 0.5 * height;
        const std::string folds = feature.folds > 0.0
                                      ? fmt::format("<folds top='{0}' bottom='{0}'/>", feature.folds)
                                      : std::string();
        text += fmt::format("<structure type='freeform' id='f{}'>{}<outline d='{}'/></structure>\n", i + 1,
                            folds, outline_of(feature, y, random));
    }
    return text + "</structurelist>\n</popup>\n";
}

}  // namespace popup::test
