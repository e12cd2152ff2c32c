// A model as pixels: a rasteriser with a depth buffer.
#pragma once

#include <cmath>

#include "output/png.h"
#include "output/still/model.h"

namespace popup::still {

struct Framing {
    Camera camera;           // of pixels; its target is the middle of what is seen
    double radius_mm = 1.0;  // of a ball about the middle that holds it all
    double ground_mm = 0.0;  // how high the ground lies: everything stands on it or above
    bool plain = false;      // the background has one colour, as pictures of few colours want it
};

// Finds a framing in which all of several models is in the picture, with a margin of a sixteenth of its width
// or of its height. Models are shown to it twice, all of them each time:
//
//     Framer framer(View::iso, 800, 600);
//     for (const Model& model : models) framer.measure(model);
//     for (const Model& model : models) framer.aim(model);
//     const Pixels first = render(models.front(), framer.framing(), 800, 600);
class Framer {
 public:
    Framer(View view, int width, int height) : Framer(eye_of(view), width, height) {}
    // `eye`: the direction to it, not upright.
    Framer(Vec3 eye, int width, int height) : eye_(eye), width_(width), height_(height) {}
    void measure(const Model& model);
    void aim(const Model& model);
    [[nodiscard]] Framing framing() const;

 private:
    [[nodiscard]] Framing unaimed() const;

    Vec3 eye_;
    int width_, height_;
    Vec3 low_{HUGE_VAL, HUGE_VAL, HUGE_VAL};
    Vec3 high_{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    Box seen_;
};

// The framing of one.
Framing framing_of(const Model& model, View view, int width, int height);

// The picture, as output/still/still.h says. Cost: nine samples a pixel, and triangles times the rows that
// they cover; a shadow map. Precondition: at least 16 pixels a side.
Pixels render(const Model& model, const Framing& framing, int width, int height);

}  // namespace popup::still
