// A plate that stays parallel to another: what stands or lies in an origamic architecture.
//
// Two plates share a fold, the back B and the floor F. A plate that is parallel to B and meets the plane of F
// along a line of F keeps that line, however the card is open: the line, the fold, and a second line on B and
// on the plate are the four corners of a parallelogram. So the plate is B moved along F, and what is parallel
// to F is F moved along B. A fold between two such plates stays closed, for both move the one fold of B and F
// by the sum of their ways; and both turn against each other as B and F do.
#include <cmath>

#include "motion/joints/joint.h"

namespace popup {
namespace {

// Beyond this the line is not parallel to the plate that its own must be parallel to: there is no such pose.
constexpr double kAslant = 1e-6;

}  // namespace

JointPlates plates_of(const Parallel& how) {
    return {{{how.plate, how.base, how.base_at, Lying::free}}, {how.base, how.like, how.carrier}};
}

// It turns against its carrier as its likeness does: one way throughout, as far as the drives do.
JointTurns turns_of(const Parallel& how) {
    JointTurns result;
    result.turns.push_back({how.plate, how.carrier, how.own_at, how.own_dir});
    result.ways.push_back({0, JointTurn::kNone});
    return result;
}

bool place_plates(const Parallel& how, Angle /*theta*/, std::span<Frame> frames) {
    const Frame& carrier = frames[static_cast<std::size_t>(how.carrier)];
    const Vec3 along = carrier.direction(how.carrier_dir);
    const Vec3 front = frames[static_cast<std::size_t>(how.like)].normal();
    if (std::abs(dot(along, front)) > kAslant) return false;
    const Vec3 aside = unit(cross(front, along));  // on the left of the line
    Frame& own = frames[static_cast<std::size_t>(how.plate)];
    const auto image = [&](Vec2 d) { return dot(d, how.own_dir) * along + cross(how.own_dir, d) * aside; };
    own.axes = {image({1, 0}), image({0, 1}), cross(along, aside)};
    own.origin = carrier.point(how.carrier_at) - own.direction(how.own_at);
    return true;
}

// All that are as far from the fold move as one body, wherever they stand along it.
Likeness likeness(const Parallel& how) {
    const Vec2 across = right_of(how.carrier_dir);
    return {how.like, how.carrier, to_compare(dot(how.carrier_at, across)),
            to_compare(std::atan2(how.carrier_dir.y, how.carrier_dir.x))};
}

// Where it is follows from all that it is folded to.
std::optional<Slid> slid(const Parallel& /*how*/, double /*mm*/) { return std::nullopt; }

std::optional<Parallelism> parallelism(const Parallel& how) {
    return Parallelism{how.plate, how.like, how.carrier};
}

std::optional<std::string> fault_of(const Parallel& how) {
    if (!is_unit(how.carrier_dir)) return "carrier_dir is no unit vector";
    if (!is_unit(how.own_dir)) return "own_dir is no unit vector";
    if (how.like == how.carrier) return "like and carrier are one plate";
    return std::nullopt;
}

}  // namespace popup
