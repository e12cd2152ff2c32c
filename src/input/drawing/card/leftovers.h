// What of a drawn card makes no feature: holes, and what is not understood.
#pragma once

#include <vector>

#include "input/drawing/card/features.h"

namespace popup::drawing::card {

struct DrawnHole {
    std::vector<int> faces;
};

struct Leftovers {
    std::vector<DrawnHole> holes;
    std::vector<NotUnderstood> faults;
    std::vector<NotUnderstood> cuts_within;    // within a feature, or the page: flaps and figures have such
    std::vector<NotUnderstood> run_on;         // folds drawn on through features: left out
    std::vector<NotUnderstood> islands;        // in holes: they fall out with them
    std::vector<NotUnderstood> cuts_on_folds;  // left out; `what` is their length
    std::vector<NotUnderstood> outside;        // of the page, once an element
    // Features share a cut, where elements need paper between them, or a hole parts a plate of one.
    bool beyond_elements = false;
    // Edges of folds that were drawn as the kind that they are, and as the other.
    std::vector<int> as_drawn, other_way;
};

// Every face, fold and cut that find_features() left is in one of them.
Leftovers find_leftovers(const SheetGraph& graph, const Features& features);

}  // namespace popup::drawing::card
