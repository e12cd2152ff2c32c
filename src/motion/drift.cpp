#include "motion/drift.h"

#include <cmath>

namespace popup {
namespace {

constexpr double kParallel = 1e-9;  // square of the sine between lines

// The point of the line at `a` that is next to the one at `b`; a itself where they are parallel.
Vec3 next_to(Vec3 a, Vec3 dir_a, Vec3 b, Vec3 dir_b) {
    const double along = dot(dir_a, dir_b);
    const double square = 1.0 - along * along;
    if (square < kParallel) return a;
    const Vec3 way = b - a;
    return a + ((dot(way, dir_a) - along * dot(way, dir_b)) / square) * dir_a;
}

}  // namespace

void Drift::turn(Vec3 at, Vec3 dir, const TurnRate& rate, double sign) {
    if (rate.most == 0.0) return;
    if (lines_ == 0) centre_ = at;
    if (lines_ == 1) centre_ = next_to(centre_, dir_, at, dir);
    // The point of the line next to the centre.
    const Vec3 centre = at + dot(centre_ - at, dir) * dir;
    centre_change_ += (spin_change_ + spin_most_ * spin_most_) * length(centre - centre_);
    ++lines_;
    centre_ = centre;
    dir_ = dir;
    spin_change_ += rate.change + rate.most * spin_most_;
    const Vec3 spin = (sign * rate.at_middle) * dir;
    spin_ = spin_ + spin;
    shift_ = shift_ - cross(spin, at);
    spin_most_ = length(spin_) + half_ * spin_change_;
}

double Drift::of(Vec3 point) const {
    if (lines_ == 0) return 0.0;
    const double change = centre_change_ + (spin_change_ + spin_most_ * spin_most_) * length(point - centre_);
    return half_ * (length(shift_ + cross(spin_, point)) + 0.5 * half_ * change);
}

double Drift::turns() const { return half_ * spin_most_; }

}  // namespace popup
