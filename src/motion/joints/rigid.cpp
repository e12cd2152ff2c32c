// A plate glued flat on another, or beside it in one plane: it moves with it.
#include "motion/joints/joint.h"

namespace popup {

JointPlates plates_of(const Rigid& how) {
    const Lying lying = how.beside               ? Lying::beside
                        : how.back || how.behind ? Lying::on_back
                                                 : Lying::on_front;
    return {{{how.plate, how.base, how.own_at, lying}}, {how.base}};
}

JointTurns turns_of(const Rigid& /*how*/) {
    JointTurns result;
    result.ways.push_back({JointTurn::kNone, JointTurn::kNone});
    return result;
}

bool place_plates(const Rigid& how, Angle /*theta*/, std::span<Frame> frames) {
    const Frame& base = frames[static_cast<std::size_t>(how.base)];
    const Vec3 along = base.direction(how.base_dir);
    // From the back the paper is seen in a mirror.
    const Vec3 aside = (how.back ? -1.0 : 1.0) * base.direction(left_of(how.base_dir));
    Frame& own = frames[static_cast<std::size_t>(how.plate)];
    const auto image = [&](Vec2 d) { return dot(d, how.own_dir) * along + cross(how.own_dir, d) * aside; };
    own.axes = {image({1, 0}), image({0, 1}), cross(along, aside)};
    own.origin = base.point(how.base_at) - own.direction(how.own_at);
    return true;
}

Likeness likeness(const Rigid& /*how*/) { return {}; }

std::optional<Slid> slid(const Rigid& how, double mm) {
    if (how.beside) return std::nullopt;  // it follows its base
    Rigid moved = how;
    moved.base_at = how.base_at + mm * how.base_dir;
    return Slid{moved, mm * how.base_dir, "line A–B"};
}

std::optional<Parallelism> parallelism(const Rigid& /*how*/) { return std::nullopt; }

std::optional<std::string> fault_of(const Rigid& how) {
    if (!is_unit(how.base_dir)) return "base_dir is no unit vector";
    if (!is_unit(how.own_dir)) return "own_dir is no unit vector";
    if (how.beside && (how.back || how.behind)) return "it lies beside its base, and so not on its back";
    if (how.back && how.behind) return "its front cannot face both ways: back and behind exclude each other";
    return std::nullopt;
}

}  // namespace popup
