// A plate that stands still: its page is the plane z = 0 of the world.
#include "motion/joints/joint.h"

namespace popup {

JointPlates plates_of(const Still& how) { return {{{how.plate, -1, {}, Lying::free}}, {}}; }

JointTurns turns_of(const Still& how) {
    JointTurns result;
    JointTurn held;
    held.plate = how.plate;
    held.dir = {1.0, 0.0};
    held.still = true;
    result.turns.push_back(held);
    result.ways.push_back({0, JointTurn::kNone});
    return result;
}

bool place_plates(const Still& how, Angle /*theta*/, std::span<Frame> frames) {
    frames[static_cast<std::size_t>(how.plate)] = Frame{};
    return true;
}

Likeness likeness(const Still& /*how*/) { return {}; }

std::optional<Slid> slid(const Still& /*how*/, double /*mm*/) { return std::nullopt; }

std::optional<Parallelism> parallelism(const Still& /*how*/) { return std::nullopt; }

std::optional<std::string> fault_of(const Still& /*how*/) { return std::nullopt; }

}  // namespace popup
