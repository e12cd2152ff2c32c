#include "output/poses.h"

#include <fmt/format.h>

#include <algorithm>

namespace popup {

Sweep sweep_of(std::span<const SceneCard> cards) {
    const auto moving = [](const SceneCard& card) { return moves(*card.assembly); };
    const auto first = std::find_if(cards.begin(), cards.end(), moving);
    if (first == cards.end()) return {};
    Sweep all = first->assembly->sweep;
    for (const SceneCard& card : cards) {
        if (!moving(card)) continue;
        all.from_deg = std::min(all.from_deg, card.assembly->sweep.from_deg);
        all.to_deg = std::max(all.to_deg, card.assembly->sweep.to_deg);
    }
    return all;
}

bool place_card(const Assembly& assembly, double angle_deg, std::span<Frame> frames,
                Diagnostics& diagnostics) {
    const double there = std::clamp(angle_deg, assembly.sweep.from_deg, assembly.sweep.to_deg);
    int stuck = 0;
    if (place(assembly, Angle::degrees(there), frames, &stuck)) return true;
    const Joint& joint = assembly.joints[static_cast<std::size_t>(stuck)];
    diagnostics
        .error("locks", joint.place,
               fmt::format("\"{}\" locks: its linkage cannot reach an opening of {:.2f}°", joint.name, there))
        .hint("make its piece wider than the place it is glued to, or close its V")
        .about(joint.name);
    return false;
}

}  // namespace popup
