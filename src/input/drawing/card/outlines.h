// The outlines of features and holes, as they are drawn once what stands on them is gone.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "input/drawing/card/leftovers.h"

namespace popup::drawing::card {

struct Outline {
    Ring ring;  // counter-clockwise, mm of the drawing; corners in the middle of straight lines left out
    std::vector<int> elements;  // that drew it, ascending
};

// Straight along its side folds, over what stands on these. Ends of its side folds lie on them exactly, and
// `moves` has what moved for that.
Outline outline_of(const SheetGraph& graph, const Features& features, const DrawnFeature& feature,
                   std::vector<Segment>& moves);
Outline outline_of(const SheetGraph& graph, const DrawnHole& hole);

}  // namespace popup::drawing::card
