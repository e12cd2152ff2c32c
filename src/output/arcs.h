// Curves as circular arcs, for formats that have these.
#pragma once

#include <optional>
#include <vector>

#include "popup/path.h"

namespace popup {

// A corner of a path of lines and arcs. `bulge` is that of the arc which begins there: the tangent of a
// quarter of its angle, positive where it runs counter-clockwise, 0 of a line.
struct ArcCorner {
    Vec2 at;
    double bulge = 0.0;
};

// The path as lines and arcs; nullopt when one of its curves is no arc to 0.001 mm. Curves that follow each
// other on one circle are one arc, of at most half a turn. A closed path has no corner where it ends, an open
// one has. Cost: linear in steps.
std::optional<std::vector<ArcCorner>> as_arcs(const Subpath& path);

}  // namespace popup
