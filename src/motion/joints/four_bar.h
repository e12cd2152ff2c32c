// The four-bar linkage: two driving plates that share a fold, two element plates that share a centre fold.
//
// Angled linkages are solved on the unit sphere about the apex, parallel ones in the plane across the fold.
// Both are written in the frame of the parent fold: along it (d), the bisector of the driving plates towards
// the front, and across from left to right. With C and S the cosine and sine of half the dihedral angle, the
// left side lies at (cos a, C sin a, −S sin a) and the right one at (cos b, C sin b, S sin b).
//
// For elements that close inside the fold (a + g = b + h = σ) the unknown centre c = (cos σ + S² v, …)
// follows from one quadratic in v whose discriminant is C² E, E = (sin g sin h)/(sin a sin b) − S²: no
// cancellation remains at either end of the motion, and E < 0 says exactly that the linkage cannot get there.
// Elements that close beyond the fold (g − a = h − b = σ) are the same with −a, −b and the signs of C and of
// the across axis turned.
#pragma once

#include <optional>

#include "motion/joints/fold_frame.h"
#include "popup/joints.h"

namespace popup {

// The frames of the element's plates; nullopt when the linkage cannot reach this dihedral angle.
struct PlatePair {
    Frame left, right;
};
std::optional<PlatePair> solve(const FourBar& bars, const Frame& left, const Frame& right);

// The frame of one element plate whose centre direction is known: `seam` and `centre` in the world (for
// parallel linkages along the fold, and from the seam to the centre fold), `at` the image of bar.own_at.
Frame plate_frame(const Bar& bar, Vec3 seam, Vec3 centre, Vec3 at);

}  // namespace popup
