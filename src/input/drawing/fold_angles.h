// How far the folds that an element draws are folded, as its attribute data-fold-angle says.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "input/drawing/shapes.h"
#include "popup/path.h"

namespace popup::drawing {

inline constexpr std::string_view kFoldAngle = "data-fold-angle";

struct FoldAngles {
    // By line of the element, or by side where `sides` has any, degrees in [-180, 180]; nullopt of one that
    // says nothing ("auto").
    std::vector<std::optional<double>> deg;
    std::vector<Polyline> sides;  // of the lines, as lines of their own, on the grid that flatten() has
};
// What an element that draws a path, in mm, as so many lines says. It has an angle for all lines, one for
// each, or, of a path without curves, one for each side; blanks or commas are between. Without the attribute,
// that of the group around it, if any. A fault goes to `problem` (bad-number).
FoldAngles fold_angles(const Attributes& attributes, std::size_t lines, const Path& path,
                       std::optional<double> around, std::optional<ShapeProblem>& problem);

// What a group says of all folds in it, one angle; without the attribute, what is said around it.
std::optional<double> inherited_angle(const Attributes& attributes, std::optional<double> around,
                                      std::optional<ShapeProblem>& problem);

// The sides of a path in mm, in the order in which it is drawn, what closes it included, on the grid that
// flatten() has; steps between points that are one there are none. None at all if one is a curve, or reaches
// further than flatten() goes. Those of a rectangle go from its first corner along x.
std::vector<Segment> straight_sides(const Path& path);

}  // namespace popup::drawing
