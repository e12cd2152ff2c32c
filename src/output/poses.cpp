#include "output/poses.h"

#include <fmt/format.h>

namespace popup {

bool place_card(const Assembly& assembly, double angle_deg, std::span<Frame> frames,
                Diagnostics& diagnostics) {
    int stuck = 0;
    if (place(assembly, Angle::degrees(angle_deg), frames, &stuck)) return true;
    const Joint& joint = assembly.joints[static_cast<std::size_t>(stuck)];
    diagnostics
        .error("locks", joint.place,
               fmt::format("\"{}\" locks: its linkage cannot reach an opening of {:.2f}°", joint.name,
                           angle_deg))
        .hint("make its piece wider than the place it is glued to, or close its V")
        .about(joint.name);
    return false;
}

}  // namespace popup
