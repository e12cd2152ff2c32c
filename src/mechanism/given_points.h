// The points of a structure on the page to the left of its fold, wherever they are given.
#pragma once

#include <vector>

#include "popup/design.h"
#include "popup/mechanism.h"

namespace popup {

// The points as measures_of() and folds_of() take them: a point of the fold itself, such as the apex of a
// v-fold, is on the page to the left of the fold. Where the fold is a seam it may be given on the page to the
// right. `seen`: the fold that it stands on, in the coordinates of its points. Precondition: it has as many
// points as `info`.
std::vector<Vec2> points_seen(const Structure& structure, const ElementInfo& info, const PageFold& seen);

// Takes such points back to the pages on which the structure gives them.
void points_as_given(const Structure& structure, const ElementInfo& info, const PageFold& seen,
                     std::vector<Vec2>& points);

}  // namespace popup
