// A base plate: half the opening to its side of a line of the world, exact at 0° and 180°.
#include <cmath>

#include "motion/joints/joint.h"

namespace popup {
namespace {

struct HalfAngle {
    double c, s;
};

// Cosine and sine of half an angle in degrees; exact at 0°, 90°, 180° and 360°.
HalfAngle half_angle(double deg) {
    if (deg == 0.0) return {1.0, 0.0};
    if (deg == 180.0) return {0.0, 1.0};
    if (deg == 90.0) return {std::sqrt(0.5), std::sqrt(0.5)};
    const double half = 0.5 * Angle::degrees(deg).rad();
    return {std::cos(half), std::sin(half)};
}

}  // namespace

JointPlates plates_of(const Drive& how) { return {{{how.plate, -1, how.axis_at, Lying::free}}, {}}; }

JointTurns turns_of(const Drive& how) {
    JointTurns result;
    result.turns.push_back({how.plate, -1, how.axis_at, how.axis_dir});
    result.ways.push_back({0, JointTurn::kNone});
    return result;
}

bool place_plates(const Drive& how, Angle theta, std::span<Frame> frames) {
    const HalfAngle half = half_angle(theta.deg);
    const Vec2 across = right_of(how.axis_dir);
    const double turn = how.turns;
    // The page's across axis goes to (s, ±c) in (across, up), its front to (∓c, s).
    const Vec3 across_to{half.s * across.x, half.s * across.y, turn * half.c};
    const Vec3 front_to{-turn * half.c * across.x, -turn * half.c * across.y, half.s};
    const Vec3 along{how.axis_dir.x, how.axis_dir.y, 0.0};
    Frame& frame = frames[static_cast<std::size_t>(how.plate)];
    frame.axes = {across.x * across_to + how.axis_dir.x * along,
                  across.y * across_to + how.axis_dir.y * along, front_to};
    frame.origin = Vec3{how.axis_at.x, how.axis_at.y, 0.0} - frame.direction(how.axis_at);
    return true;
}

Likeness likeness(const Drive& /*how*/) { return {}; }

std::optional<Slid> slid(const Drive& /*how*/, double /*mm*/) { return std::nullopt; }

std::optional<std::string> fault_of(const Drive& how) {
    if (!is_unit(how.axis_dir)) return "axis_dir is no unit vector";
    return std::nullopt;
}

std::optional<Parallelism> parallelism(const Drive& /*how*/) { return std::nullopt; }

}  // namespace popup
