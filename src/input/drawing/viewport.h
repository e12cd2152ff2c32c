// A picture within a drawing: an svg element inside another, or a symbol that is used.
#pragma once

#include <optional>

#include "input/drawing/shapes.h"
#include "input/drawing/transform.h"

namespace popup::drawing {

struct Viewport {
    Affine from_inside;  // to the coordinates around
    Vec2 view;           // its size in its own units, for percentages
    Vec2 size;           // of its rectangle, in the units around
};

// How wide and high a use element wants what it stands for.
struct WantedSize {
    std::optional<double> width, height;
};

// In one whose view is `around`. Of an svg element what a use wants outweighs what it says itself. Nullopt of
// one without width or height, in which nothing is drawn, and after a fault.
std::optional<Viewport> viewport_of(const Attributes& attributes, Vec2 around, const WantedSize& wanted,
                                    std::optional<ShapeProblem>& problem);

}  // namespace popup::drawing
