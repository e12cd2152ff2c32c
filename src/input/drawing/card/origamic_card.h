// A drawn card that is no sum of elements: an origamic architecture, whose folds all run along the gutter and
// whose plates stay parallel to one of the two halves of the page. So flaps that stand up at a fold, figures
// taller than what they stand on, and stairs whose steps share a cut, are read as they are drawn.
#pragma once

#include <optional>
#include <vector>

#include "input/drawing/card/features.h"
#include "popup/assembly.h"

namespace popup::drawing::card {

struct OrigamicCard {
    Assembly assembly;
    double off = 0.0;     // how far corners were moved at most, so that the folds are parallel; mm
    int off_element = 0;  // that drew the fold there
    // Edges of folds that were drawn as the kind that they are, and as the other.
    std::vector<int> as_drawn, other_way;
};

// nullopt where it is none: a fold runs otherwise or is drawn on through the paper, a line ends in the paper,
// folds that lead round something do not come back to the plane they left (by more than 0.5 mm), paper at the
// border of the page is cut off, or the card when it opens does not say how everything moves; `why` says
// which, and where. Features give what hangs together. Cost: near linear in edges, and the cube of the number
// of plates for how they move, of which there may be 500.
std::optional<OrigamicCard> origamic_card(const Tracing& tracing, const SheetGraph& graph,
                                          const CardPage& page, const Features& features,
                                          const std::vector<const TracedLine*>& printed,
                                          const std::vector<Segment>& moves, NotUnderstood& why);

// Where origamic_card() finds none: stretches of folds that are drawn on beyond a cut, through plates that
// other folds hold. Edges, ascending; without them it may find one.
std::vector<int> folds_drawn_on(const SheetGraph& graph, const CardPage& page, const Features& features);

}  // namespace popup::drawing::card
