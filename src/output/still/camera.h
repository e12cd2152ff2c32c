// A view of the world in perspective: where points of it fall in a picture.
#pragma once

#include <optional>

#include "popup/geometry.h"
#include "popup/output.h"

namespace popup::still {

// A point of a picture. Along a straight line of the world `near` runs evenly over the picture; it is more
// than 0, and larger where it is nearer.
struct Seen {
    double x = 0.0, y = 0.0, near = 0.0;
};

struct Camera {
    Vec3 right, up, back;       // of the picture; unit; back leads to the eye
    Vec3 target;                // what the eye looks at
    double eye_mm = 1.0;        // its distance from there
    double scale = 1.0;         // pixels a mm at the target
    double cx = 0.0, cy = 0.0;  // where the target falls

    // Precondition: the point lies before the eye.
    [[nodiscard]] Seen see(Vec3 p) const {
        const Vec3 d = p - target;
        const double near = 1.0 / (eye_mm - dot(d, back));
        const double s = scale * eye_mm * near;
        return {cx + s * dot(d, right), cy - s * dot(d, up), near};
    }
    // The point of the world that is seen there.
    [[nodiscard]] Vec3 point(double x, double y, double near) const {
        const double away = 1.0 / near;
        const double s = away / (scale * eye_mm);
        return target + s * (x - cx) * right + s * (cy - y) * up + (eye_mm - away) * back;
    }
    [[nodiscard]] Vec3 eye() const { return target + eye_mm * back; }
};

// From where a view looks: the direction to the eye; z is up, and who looks from before has x on the right.
Vec3 eye_of(View view);

// Looks at the middle of a ball that holds everything, from outside of it; `eye` is the direction to the eye,
// not upright. Scale and middle of the picture
// are still to be set.
Camera camera_at(Vec3 eye, Vec3 centre, double radius_mm);

}  // namespace popup::still
