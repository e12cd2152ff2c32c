#include "motion/joints/fold_frame.h"

namespace popup {

FoldFrame fold_frame(const DrivenSide& left, const DrivenSide& right, bool outside) {
    const Vec3 out_l = left.plate.direction(left.out);
    const Vec3 out_r = right.plate.direction(right.out);
    const Vec3 normals = left.plate.normal() + right.plate.normal();
    const Vec3 outs = out_l + out_r;
    FoldFrame fold;
    fold.along = left.plate.direction(left.along);
    fold.s = 0.5 * length(out_r - out_l);
    // Near 0° and 360° the normals' sum vanishes: there the kind of closing says which of the two it is.
    if (fold.s > 0.5) {
        fold.c = 0.5 * dot(outs, unit(normals));
    } else {
        fold.c = 0.5 * length(outs) * (outside ? -1.0 : 1.0);
    }
    fold.bisector = 0.5 * (fold.s * normals + fold.c * outs);
    fold.across = 0.5 * (fold.s * (out_r - out_l) + fold.c * (left.plate.normal() - right.plate.normal()));
    return fold;
}

Frame frame_between(Vec2 own_at, Vec2 own_along, Vec2 own_across, Vec3 at, Vec3 along, Vec3 across) {
    const double side = cross(own_along, own_across) < 0.0 ? -1.0 : 1.0;
    Frame frame;
    frame.axes = {own_along.x * along + own_across.x * across, own_along.y * along + own_across.y * across,
                  side * cross(along, across)};
    frame.origin = at - frame.direction(own_at);
    return frame;
}

}  // namespace popup
