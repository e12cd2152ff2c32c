// The door between layout and the packing of shapes: lay_out() knows nothing of how places are found.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "popup/geometry.h"
#include "popup/layout.h"
#include "popup/units.h"

namespace popup {

// What is to be placed: a piece's silhouette, made ready once.
struct Shape {
    const std::vector<Polygon>* outline = nullptr;  // not owned
    Ring hull;
};
// Precondition: the outline has an area and lies within ±1e8 mm.
Shape make_shape(const std::vector<Polygon>& outline);

// The part of a sheet that may be used, in mm: margins are taken off.
struct SheetArea {
    double width = 0.0;
    double height = 0.0;
};

struct PackRules {
    double spacing = 0.0;  // mm, between shapes
    Rotation rotation;
};

// Where a shape goes: p ↦ turned(p, angle) + offset, from the lower left corner of the usable area.
struct Spot {
    int sheet = 0;
    Vec2 offset;
    Angle angle;
};

// Whether some allowed turn of the shape lies within the area, to 1e-6 mm.
bool fits(const Shape& shape, const SheetArea& area, Rotation rotation);

// Places shapes[i] for each i of `items` on as few sheets as can be found, and within as short a part (along
// the width) of the last sheet. Every shape's box lies in the area, and no two boxes of a sheet are closer
// than the spacing, to 1e-6 mm. Results depend on nothing but the arguments. nullopt when a shape does not
// fit. Cost: near linear in items; many ways are tried while there are few of them.
std::optional<std::vector<Spot>> pack(std::span<const Shape> shapes, std::span<const int> items,
                                      const SheetArea& area, const PackRules& rules);

}  // namespace popup
