// A folded sheet whose panels share no corners but those of the folds between them.
#pragma once

#include <vector>

#include "folded/carton/rough.h"

namespace popup::folded {

struct ApartShape {
    RoughShape shape;                       // without loops
    std::vector<std::vector<int>> corners;  // by panel, those of slits in its middle included
};

// The same shape, with corners of its own for all that only a slit parts, so that either side can be moved
// alone. Every edge of a panel that is no fold is a cut of its own. Cost: near linear in corners, and panels
// times slits in the middle of them.
ApartShape cut_apart(const RoughShape& rough);

}  // namespace popup::folded
