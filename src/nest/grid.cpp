#include "nest/grid.h"

namespace popup {

Vec2 turned(Vec2 p, Angle angle) {
    if (angle.deg == 0.0) return p;
    if (angle.deg == 90.0) return {-p.y, p.x};
    if (angle.deg == 180.0) return {-p.x, -p.y};
    if (angle.deg == 270.0) return {p.y, -p.x};
    return rotated(p, angle.rad());
}

GridRing turned_ring(const Ring& ring, Angle angle) {
    GridRing points;
    points.reserve(ring.size());
    for (const Vec2 p : ring) {
        const Vec2 q = turned(p, angle);
        const GridPoint g{to_grid(q.x), to_grid(q.y)};
        if (points.empty() || points.back() != g) points.push_back(g);
    }
    while (points.size() > 1 && points.front() == points.back()) points.pop_back();
    return points;
}

Ring in_mm(const GridRing& ring) {
    Ring points;
    points.reserve(ring.size());
    for (const GridPoint p : ring) points.push_back({from_grid(p.x), from_grid(p.y)});
    return points;
}

}  // namespace popup
