// Panels that lie on others in a folded shape: glue flaps, tucks, dust flaps.
#pragma once

#include <vector>

#include "folded/carton/vertices.h"

namespace popup::folded {

struct LyingFlap {
    int flap = 0, panel = 0;
    bool same_way = true;              // their fronts show the same way
    double near = 0.0, far = 0.0;      // mm, of the flap's corners above the panel, least and most
    double outside = 0.0;              // mm², of the flap, that is beside the panel
    double beside = 0.0;               // mm: how far its corners are beside it at most
    [[nodiscard]] double off() const;  // mm, of the corner furthest from the panel
};

// Where a flap lies on a panel in another state of a sheet with the same panels.
LyingFlap lying_in(const FoldedState& state, int flap, int panel);

// By flap that lies with more than half of its area on a panel that it does not hang on, parallel to it, and
// no corner further off than Vertices::meet_mm(): that of which it has most. Cost: near linear in panels,
// times those that are near one another.
std::vector<LyingFlap> lying_panels(const Vertices& shape);

}  // namespace popup::folded
