#include "output/still/camera.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace popup::still {
namespace {

constexpr double kEyeRadii = 5.0;

Vec3 unit_of(Vec3 v) { return (1.0 / std::sqrt(dot(v, v))) * v; }

// Where the eye lies; in the order of View.
constexpr std::array<Vec3, kViewNames.size()> kEyes{Vec3{0.35, -1.2, 0.62}, Vec3{0.0, -1.0, 0.12},
                                                    Vec3{0.0, -0.001, 1.0}, Vec3{-1.0, -0.15, 0.25},
                                                    Vec3{1.0, -0.15, 0.25}, Vec3{0.35, 1.2, 0.62}};

}  // namespace

Vec3 eye_of(View view) { return kEyes.at(static_cast<std::size_t>(view)); }

Camera camera_at(Vec3 eye, Vec3 centre, double radius_mm) {
    Camera camera;
    camera.back = unit_of(eye);
    camera.right = unit_of(cross({0, 0, 1}, camera.back));
    camera.up = cross(camera.back, camera.right);
    camera.target = centre;
    camera.eye_mm = kEyeRadii * radius_mm;
    return camera;
}

}  // namespace popup::still
