// Plates as a tree of nodes, each turning about its pivot: how a viewer of a scene puts them in their places.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "popup/assembly.h"
#include "popup/geometry.h"

namespace popup {

using Quaternion = std::array<double, 4>;  // x, y, z, w, as glTF has it

struct HingeTree {
    std::vector<int> order;  // all plates, parents before children
    std::vector<Vec3>
        offset;  // of each plate: its pivot in its parent's node (without parent: in the world), mm
};

// `rest`: frames of all plates at any one angle. Offsets are rounded to 1e-6 mm.
HingeTree hinge_tree(const Assembly& assembly, std::span<const Frame> rest);

// Each plate's turn against its parent (without parent: against the world), as 32-bit numbers hold it,
// rounded before that to 1e-9; w ≥ 0 unless rounding says otherwise.
void local_turns(const Assembly& assembly, std::span<const Frame> frames, std::span<Quaternion> turns);

// The frames that a viewer finds from the tree and the turns.
void compose(const Assembly& assembly, const HingeTree& tree, std::span<const Quaternion> turns,
             std::span<Frame> frames);

// First b, then a.
Quaternion product(const Quaternion& a, const Quaternion& b);

// The turn in the middle of two, by the shorter way: what spherical linear interpolation gives there.
Quaternion halfway(const Quaternion& a, const Quaternion& b);

}  // namespace popup
