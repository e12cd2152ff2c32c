// What the joints share whose walls stand in the bisector of their fold: prism.cpp and lift.cpp.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "motion/joints/fold_frame.h"
#include "motion/joints/joint.h"

namespace popup {

// The parent fold of two walls.
FoldFrame fold_frame(const Upright& left, const Upright& right, std::span<const Frame> frames, bool outside);
// Where the wall stands.
Frame wall_frame(const Upright& wall, const FoldFrame& fold, const Frame& drive);
// A leaf at a point of the world, with its directions there.
Frame leaf_frame(const Leaf& leaf, Vec3 at, Vec3 along, Vec3 across);
// The wall's turn against the plate that drives it. It follows the parent fold, half as far.
JointTurn turn_of(const Upright& wall);

// The joint, of either kind, of an element that was drawn `mm` further along its fold.
template <typename Kind>
Slid slid_along_fold(Kind how, double mm) {
    const Vec2 by = mm * how.left.fold_dir;
    for (Upright* wall : {&how.left, &how.right}) {
        wall->fold_at = wall->fold_at + mm * wall->fold_dir;
        wall->foot_at = wall->foot_at + mm * wall->fold_dir;
    }
    return {how, by, "fold"};
}
// What is wrong with the values, as of fault_of() of popup/joints.h.
std::optional<std::string> fault_of(const Upright& left, const Upright& right);
std::optional<std::string> fault_of(const Leaf& leaf, std::string_view name);

}  // namespace popup
