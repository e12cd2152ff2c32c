// What is cut from one sheet across a fold, its border drawn: where its folds are, and which parts of it move
// together (docs/elements.md, "Cut from one sheet").
//
// Seen along the fold, with y to its left: the side folds lie p above it and q below it, and the centre fold
// p - q above it, as of a step. A wavy border may meet each of these lines several times. Then a side fold
// has several stretches; what is beyond the centre fold and hangs on no side fold stays level with what it
// hangs on; and parts of one side that hang on different stretches are plates of their own that move alike.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mechanism/border.h"
#include "mechanism/shapes.h"

namespace popup {

// The shortest stretch of a side fold, in mm.
inline constexpr double kLeastEdgeMm = 2.0;

struct SheetFault {
    std::string code, what, hint;
};

// Distances of the side folds from the fold, in mm, where the author gave them.
struct SideFolds {
    std::optional<double> left, right;
};

// The shape of a parallel linkage, in page coordinates, bars and all, and the lines of its row's three folds.
struct CutShape {
    SlitShape slit;
    FoldLines folds;
    std::vector<FlatCurve> curves;
};

// Where the border crosses the line of the fold, as stretches of paper on it (mm along it).
std::vector<std::pair<double, double>> on_fold(const Border& border);

// Why a border that crosses the line of the fold otherwise than twice is no shape.
SheetFault crosses_otherwise(std::size_t chords);

// Divides the border, which is in coordinates of the site and touches itself nowhere. A side fold that was
// not given lies as far out as there are kLeastEdgeMm of it; what lies further out is left to the page.
std::optional<SheetFault> shape_of(const Element& element, const Border& border, const SideFolds& given,
                                   CutShape& into);

}  // namespace popup
