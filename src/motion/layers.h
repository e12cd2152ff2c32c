// Plates over one another in the closed card, just before it is closed.
#pragma once

#include <span>
#include <vector>

#include "motion/plate_shape.h"
#include "motion/recall.h"
#include "popup/assembly.h"

namespace popup {

// The closed card seen from the side: x away from the gutter, y along it; `up` from the left cover to the
// right one.
struct ClosedPlane {
    Vec3 origin, x, y, up;

    [[nodiscard]] Vec2 flat(Vec3 p) const { return {dot(p - origin, x), dot(p - origin, y)}; }
    [[nodiscard]] Vec3 direction(Vec2 d) const { return d.x * x + d.y * y; }
    [[nodiscard]] Vec3 in_world(Vec2 p) const { return origin + direction(p); }
};

// Plates closer than this at the smallest angle are not told apart.
inline constexpr double kHeightMm = 1e-9;

// Plates over one another, and how.
struct Overlap {
    int a, b;            // a < b
    double least, most;  // of b's height over a, as far as they say whether it is above or below
};

struct Layers {
    std::vector<Overlap> overlaps;  // by a, b
    std::vector<Frame> frames;      // by plate
    int most = 0;                   // plates over one point; 0: too many to count
    Vec2 thickest;                  // such a point; of several the first one, from the gutter outwards
};

// All at the least opening, which the joints reach. `recall`: pairs that are as they were, and where nothing
// else has changed, are not looked at again; null: all are. Cost: n log n in triangles, and in pairs of
// plates that lie over one another.
Layers look_at_layers(const Assembly& assembly, std::span<const PlateShape> shapes, const ClosedPlane& plane,
                      Recall* recall);

}  // namespace popup
