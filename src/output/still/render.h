// A model as pixels: a rasteriser with a depth buffer.
#pragma once

#include "output/png.h"
#include "output/still/model.h"

namespace popup::still {

struct Framing {
    Camera camera;           // of pixels; its target is the middle of what is seen
    double radius_mm = 1.0;  // of a ball about the middle that holds it all
    double ground_mm = 0.0;  // how high the ground lies, along Stand::up: everything stands on it or above
};

// All of the model in the picture, with a margin of a sixteenth of its width or of its height.
Framing framing_of(const Model& model, View view, int width, int height);

// That picture, as output/still/still.h says. Cost: nine samples a pixel, and triangles
// times the rows that they cover; a shadow map. Precondition: at least 16 pixels a side.
Pixels render(const Model& model, View view, int width, int height);

}  // namespace popup::still
