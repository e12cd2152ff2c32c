#include "motion/joints/upright.h"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace popup {

FoldFrame fold_frame(const Upright& left, const Upright& right, std::span<const Frame> frames, bool outside) {
    return fold_frame({frames[static_cast<std::size_t>(left.drive)], left.fold_dir, left.fold_out},
                      {frames[static_cast<std::size_t>(right.drive)], right.fold_dir, right.fold_out},
                      outside);
}

Frame wall_frame(const Upright& wall, const FoldFrame& fold, const Frame& drive) {
    return frame_between(wall.own_at, wall.own_along, wall.own_across, drive.point(wall.foot_at), fold.along,
                         fold.bisector);
}

Frame leaf_frame(const Leaf& leaf, Vec3 at, Vec3 along, Vec3 across) {
    return frame_between(leaf.own_at, leaf.own_along, leaf.own_across, at, along, across);
}

JointTurn turn_of(const Upright& wall) { return {wall.plate, wall.drive, wall.own_at, wall.own_along}; }

std::optional<std::string> fault_of(const Leaf& leaf, std::string_view name) {
    if (!is_unit(leaf.own_along)) return fmt::format("{}: own_along is no unit vector", name);
    if (!is_unit(leaf.own_across)) return fmt::format("{}: own_across is no unit vector", name);
    if (!are_square(leaf.own_along, leaf.own_across))
        return fmt::format("{}: own_across is not square to own_along", name);
    return std::nullopt;
}

std::optional<std::string> fault_of(const Upright& left, const Upright& right) {
    if (left.drive == right.drive || left.plate == right.plate)
        return "its left and its right side are one plate";
    const std::array<std::pair<std::string_view, const Upright*>, 2> walls{
        {{"left", &left}, {"right", &right}}};
    for (const auto& [side, wall] : walls) {
        if (!is_unit(wall->fold_dir)) return fmt::format("{}: fold_dir is no unit vector", side);
        if (!is_unit(wall->fold_out)) return fmt::format("{}: fold_out is no unit vector", side);
        if (!are_square(wall->fold_dir, wall->fold_out))
            return fmt::format("{}: fold_out is not square to fold_dir", side);
        if (auto fault = fault_of({wall->plate, wall->own_at, wall->own_along, wall->own_across}, side))
            return fault;
        if (!(wall->near > 0.0)) return fmt::format("{}: near_mm is not more than 0", side);
        const double near = dot(wall->foot_at - wall->fold_at, wall->fold_out);
        if (!same_length(near, wall->near))
            return fmt::format("{}: near_mm is {:.6f}, but foot_at is {:.6f} from the fold", side, wall->near,
                               near);
    }
    return std::nullopt;
}

}  // namespace popup
