// Rigid motions of space, as loops of folds compose them.
#pragma once

#include <array>
#include <cmath>

#include "folded/sine.h"
#include "popup/geometry.h"

namespace popup::folded {

// A rigid motion: x to axes x + shift; axes by columns.
struct Rigid3 {
    std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    Vec3 shift;

    [[nodiscard]] Vec3 direction(Vec3 d) const { return d.x * axes[0] + d.y * axes[1] + d.z * axes[2]; }
    [[nodiscard]] Vec3 point(Vec3 p) const { return shift + direction(p); }
    // Of one in the plane of the sheet: d.z is 0.
    [[nodiscard]] Vec3 direction_in_sheet(Vec3 d) const { return d.x * axes[0] + d.y * axes[1]; }
    // This motion after a turn about a line in the plane of the sheet through its origin; dir.z is 0, and
    // `along` where this motion leads it.
    [[nodiscard]] Rigid3 after_turn_at_origin(Vec3 dir, Vec3 along, SineCosine of_angle) const {
        const double s = of_angle.sine;
        const double c = of_angle.cosine;
        // Across the line and out of the sheet are turned into each other.
        const Vec3 across = dir.x * axes[1] - dir.y * axes[0];
        const Vec3 turned = c * across + s * axes[2];
        Rigid3 result;
        result.axes = {dir.x * along - dir.y * turned, dir.y * along + dir.x * turned,
                       c * axes[2] - s * across};
        result.shift = shift;
        return result;
    }
    // This motion after a turn about a line.
    [[nodiscard]] Rigid3 after_turn(Vec3 at, Vec3 dir, double angle) const {
        return after_turn(at, dir, sine_cosine(angle));
    }
    [[nodiscard]] Rigid3 after_turn(Vec3 at, Vec3 dir, SineCosine of_angle) const {
        const double c = of_angle.cosine;
        const double s = of_angle.sine;
        const auto turned = [&](Vec3 v) {
            return c * v + s * cross(dir, v) + ((1.0 - c) * dot(dir, v)) * dir;
        };
        Rigid3 result;
        result.axes = {direction(turned({1, 0, 0})), direction(turned({0, 1, 0})),
                       direction(turned({0, 0, 1}))};
        result.shift = point(at - turned(at));
        return result;
    }
};

// The turn of a motion as axis times angle, exact to the first order in small turns and right up to a half.
inline Vec3 turn_of(const Rigid3& motion) {
    const Vec3 twice_sine{motion.axes[1].z - motion.axes[2].y, motion.axes[2].x - motion.axes[0].z,
                          motion.axes[0].y - motion.axes[1].x};
    const double trace = motion.axes[0].x + motion.axes[1].y + motion.axes[2].z;
    const double sine = 0.5 * length(twice_sine);
    if (sine < 1e-6 && trace > 0.0) return 0.5 * twice_sine;
    if (sine < 1e-9) return {3.14, 0.0, 0.0};  // about half a turn: far from closed, the axis does not matter
    return (angle_of(sine, 0.5 * (trace - 1.0)) / (2.0 * sine)) * twice_sine;
}

}  // namespace popup::folded
