// What holds the pieces of an assembly together, and where plates are while they are glued.
#pragma once

#include <vector>

#include "popup/gluing.h"

namespace popup {

// Every tab, area and rivet: tabs, then areas, then rivets, in the order of the assembly.
std::vector<Bond> bonds_of(const Assembly& assembly);

// Some places of a tab's or area's target, on the page of what it is glued to; its middle comes first.
// Precondition: it is no rivet.
std::vector<Vec2> target_places(const Assembly& assembly, const Bond& bond);
// The same in the world, of rivets too.
std::vector<Vec3> target_points(const Assembly& assembly, const Bond& bond, const std::vector<Frame>& frames);

// Frames of all plates at some openings; empty where nothing moves.
struct GluePoses {
    std::vector<Frame> open;   // as far as the card goes
    std::vector<Frame> reach;  // nearly: what is above what
    std::vector<Frame> half;
    std::vector<Frame> ajar;  // nearly closed
    [[nodiscard]] bool empty() const { return open.empty(); }
};
GluePoses poses_of(const Assembly& assembly);

}  // namespace popup
