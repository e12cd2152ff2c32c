// What elements share that fold like a step: the step itself, and the box fold, which is given by two
// corners. Points A B on the left side fold, G H on the right one: the points of the fold's page.
#pragma once

#include <array>
#include <utility>

#include "mechanism/measures.h"

namespace popup::step {

inline constexpr std::array<PointInfo, 4> kPoints{{{"A", PointPage::fold, 'L'},
                                                   {"B", PointPage::fold, 'L'},
                                                   {"G", PointPage::fold, 'R'},
                                                   {"H", PointPage::fold, 'R'}}};
inline constexpr std::array<int, 4> kPartners{2, 3, 0, 1};
enum : std::size_t { A, B, G, H };

inline constexpr std::array<MeasureInfo, 6> kMeasures{
    {measure::kAt, measure::kLength, measure::kWidth, measure::kOffset, measure::kShift, measure::kTaper}};
// The measures of all that has two points on either side, at one distance from the fold: in this order.
std::vector<double> measured(const Element& e);
void shape(Element& e, std::span<const double> values);

// The stretch of the fold between the cuts A–G and B–H.
std::pair<double, double> span(const Element& e);
// Makes the side folds parallel to the fold, and the step fit on its paper; false after failed(). Messages
// call it by its family.
bool constrain(Element& e);
FoldLines fold_lines(const Element& e);
// Precondition: constrain() returned true.
void lower(const Element& e, Builder& builder);

}  // namespace popup::step
