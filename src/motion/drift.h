// How far a plate moves over a range of openings, told from how it moves in the middle of it.
//
// Along a chain of folds the turns undo one another: in a sheet that is folded like an accordion the last
// panel hardly turns, though every fold does. What bounds the motion of a plate by how far each fold turns,
// all added up, therefore says little about long chains. Here the velocities are added with their directions,
// as they are in the middle of the range, and only their changes as bounds.
//
// Let body i turn about the line i of body i - 1, its direction u_i, by an angle whose first and second
// derivatives are r_i and r'_i. Then its angular velocity W_i = W_(i-1) + r_i u_i changes by
//
//     W'_i = W'_(i-1) + r'_i u_i + r_i W_(i-1) × u_i,
//
// and a point p of body i, whose distance from a point c of the same body stays what it is, is accelerated by
//
//     p'' = c'' + W'_i × (p - c) + W_i × (W_i × (p - c)).
//
// Points c_i on the lines belong to both bodies, so that bounds for c'' are added up from line to line, and
// none of them grows faster than in proportion to the length of the chain, but for what the range itself
// adds.
#pragma once

#include "motion/turn_law.h"
#include "popup/geometry.h"

namespace popup {

// How points of a body move over a range: no further from where they are in its middle than this says.
class Drift {
 public:
    // A body at rest; `half` is half the range, radians of opening.
    explicit Drift(double half) : half_(half) {}

    // From the body on which this line is to the one that turns about it at that rate (sign: of the
    // direction).
    void turn(Vec3 at, Vec3 dir, const TurnRate& rate, double sign);

    // mm; grows towards the outside, so that no point of a triangle moves further than its furthest corner.
    [[nodiscard]] double of(Vec3 point) const;
    // Radians by which the body turns at most.
    [[nodiscard]] double turns() const;

 private:
    double half_;
    Vec3 spin_{}, shift_{};   // in the middle: the velocity of p is shift_ + spin_ × p
    double spin_most_ = 0.0;  // in the range
    double spin_change_ = 0.0;
    int lines_ = 0;
    Vec3 centre_{}, dir_{};       // on the last line
    double centre_change_ = 0.0;  // its acceleration at most
};

}  // namespace popup
