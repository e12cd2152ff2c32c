// What lies flat on another plate, on the page of that plate.
#pragma once

#include "popup/geometry.h"

namespace popup {

// A polygon of one page where it lies on another, given where both are: dropped to that page's plane.
inline Polygon on_other_page(Polygon polygon, const Frame& from, const Frame& to) {
    const auto move = [&](Ring& ring) {
        for (Vec2& p : ring) {
            const Vec3 off = from.point(p) - to.origin;
            p = {dot(off, to.axes[0]), dot(off, to.axes[1])};
        }
    };
    move(polygon.outer);
    for (Ring& hole : polygon.holes) move(hole);
    return polygon;
}

}  // namespace popup
