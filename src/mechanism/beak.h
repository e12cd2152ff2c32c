// What elements share that fold like a beak: the beak itself, and the pivot, which is one with a piece on it.
// Points A (apex), B left, E right: the first three of the fold's page.
#pragma once

#include <utility>

#include "mechanism/measures.h"
#include "mechanism/shapes.h"

namespace popup::beak {

enum : std::size_t { A, B, E };

inline constexpr std::array<MeasureInfo, 6> kMeasures{
    {measure::kApexAt, measure::kWidth, measure::kOffset, measure::kAngle, measure::kSkew, measure::kOpens}};
// The measures of its three points, in this order.
std::vector<double> measured(const Element& e);
void shape(Element& e, std::span<const double> values);

// +1 when it opens along the fold's direction, -1 when against it.
int direction(const Element& e);
// The stretch of the fold between the apex and the cut B–E.
std::pair<double, double> span(const Element& e);
// What a side's plane loses: from the apex along the side fold, and to the fold along the cut.
Ring half(const Element& e, Side side);

// Whether its sides open by no more than beaks may.
bool opens_within_limit(const Element& e);
// Puts the apex on the fold, and turns the sides in where they open too far; false after failed().
bool constrain_sides(Element& e);
// The same, and makes it fit on its paper.
bool constrain(Element& e);

FoldLines fold_lines(const Element& e);
// For lower_slit(). Precondition: constrain_sides() returned true.
SlitShape shape_of(const Element& e, const FoldLines& folds);

}  // namespace popup::beak
