// The parent fold of a joint in the world, and plates placed by a point and two directions.
#pragma once

#include "popup/joints.h"

namespace popup {

// One driving plate, and the parent fold as its page has it.
struct DrivenSide {
    const Frame& plate;
    Vec2 along, out;  // unit: along the fold, and from the fold into the plate
};

// From the frames of the two driving plates.
struct FoldFrame {
    Vec3 along, bisector, across;  // unit, mutually perpendicular to rounding; across: from left to right
    double c = 0.0, s = 1.0;       // of half the dihedral angle on the front side; s ≥ 0
};
// `outside`: the fold is a mountain fold, closed at 360°; else it closes at 0°.
FoldFrame fold_frame(const DrivenSide& left, const DrivenSide& right, bool outside);

// The frame of a plate on whose page `own_at` lies at `at`, and whose directions `own_along` and `own_across`
// run in these two of the world. All unit and perpendicular.
Frame frame_between(Vec2 own_at, Vec2 own_along, Vec2 own_across, Vec3 at, Vec3 along, Vec3 across);

}  // namespace popup
