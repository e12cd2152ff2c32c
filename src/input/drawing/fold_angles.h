// How far the folds that an element draws are folded, as its attribute data-fold-angle says.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "input/drawing/shapes.h"

namespace popup::drawing {

inline constexpr std::string_view kFoldAngle = "data-fold-angle";

// By line of the element, degrees in [-180, 180]; nullopt of a line that says nothing ("auto"). Without the
// attribute, none. It has an angle for all lines or one for each, with blanks or commas between. A fault goes
// to `problem` (bad-number).
std::vector<std::optional<double>> fold_angles(const Attributes& attributes, std::size_t lines,
                                               std::optional<ShapeProblem>& problem);

}  // namespace popup::drawing
