#include "fabrication/marks.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "popup/diagnostics.h"

namespace popup {
namespace {

// Crosses stand where common printers still print: 5 mm from the edges.
constexpr double kCrossAtMm = 7.5;
constexpr double kCrossArmMm = 2.5;
constexpr double kRingMm = 1.5;

// The figures of Silhouette's own marks: Studio's defaults for its cutters.
constexpr double kInsetMm = 10.0;
constexpr double kSquareMm = 5.0;
constexpr double kBracketMm = 20.0;

// The bar lies this far below the pieces; its figure on its right.
constexpr double kBelowMm = 2.0;
constexpr double kTickMm = 1.0;
constexpr double kFigureAtMm = 9.0;
// On each side: a bracket's arm, or the figure.
constexpr double kAsideMm = 32.0;

SheetMark line(Vec2 a, Vec2 b) { return {{a, b}, false, false}; }

SheetMark ring(Vec2 at, double radius) {
    constexpr int kCorners = 48;
    SheetMark mark{{}, true, false};
    for (int i = 0; i < kCorners; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / kCorners;
        mark.points.push_back(at + radius * Vec2{std::cos(angle), std::sin(angle)});
    }
    return mark;
}

std::vector<SheetMark> crosses(double width, double height) {
    std::vector<SheetMark> marks;
    const double right = width - kCrossAtMm;
    const double top = height - kCrossAtMm;
    for (const Vec2 at :
         {Vec2{kCrossAtMm, top}, Vec2{right, top}, Vec2{kCrossAtMm, kCrossAtMm}, Vec2{right, kCrossAtMm}}) {
        // A sheet that was turned shows it: one corner is not like the others.
        if (marks.empty()) marks.push_back(ring(at, kRingMm));
        marks.push_back(line(at - Vec2{kCrossArmMm, 0.0}, at + Vec2{kCrossArmMm, 0.0}));
        marks.push_back(line(at - Vec2{0.0, kCrossArmMm}, at + Vec2{0.0, kCrossArmMm}));
    }
    return marks;
}

std::vector<SheetMark> square_and_brackets(double width, double height) {
    const double left = kInsetMm;
    const double bottom = kInsetMm;
    const double right = width - kInsetMm;
    const double top = height - kInsetMm;
    return {
        {{{left, top - kSquareMm}, {left + kSquareMm, top - kSquareMm}, {left + kSquareMm, top}, {left, top}},
         true,
         true},
        {{{right - kBracketMm, top}, {right, top}, {right, top - kBracketMm}}, false, false},
        {{{left, bottom + kBracketMm}, {left, bottom}, {left + kBracketMm, bottom}}, false, false}};
}

}  // namespace

double clear_of(Marks marks) {
    switch (marks) {
        case Marks::none:
            return 0.0;
        case Marks::corners:
            return kCrossAtMm + kCrossArmMm;
        case Marks::silhouette:
            return kInsetMm + kSquareMm + 1.0;
    }
    broken_invariant("marks are one of their enumerators", __FILE__, __LINE__);
}

std::vector<SheetMark> registration_marks(Marks marks, double width_mm, double height_mm) {
    switch (marks) {
        case Marks::none:
            return {};
        case Marks::corners:
            return crosses(width_mm, height_mm);
        case Marks::silhouette:
            return square_and_brackets(width_mm, height_mm);
    }
    broken_invariant("marks are one of their enumerators", __FILE__, __LINE__);
}

ReferenceBar reference_bar(double length_mm, double width_mm, double margin_mm) {
    const double a = 0.5 * (width_mm - length_mm);
    const double b = a + length_mm;
    const double y = std::max(margin_mm, kReferenceMarginMm) - kBelowMm;
    return {{line({a, y}, {b, y}), line({a, y - kTickMm}, {a, y + kTickMm}),
             line({b, y - kTickMm}, {b, y + kTickMm})},
            {b + kFigureAtMm, y}};
}

double longest_reference(double width_mm) { return width_mm - 2.0 * kAsideMm; }

}  // namespace popup
