// Whether the linkages pass the whole way from closed to open.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "motion/linkage.h"
#include "popup/motion.h"

namespace popup {

// The mechanisms of an assembly that are taken through its sweep.
struct Walked {
    std::vector<std::size_t> joints;  // that are placed, in order
    std::vector<int> plates;          // that must neither lock nor jump
    std::vector<int> turns;           // by which that is judged, of plates that are placed
    std::vector<int> parent_folds;    // of the joints of these plates: turns
};
// All of them.
Walked walk_of_all(const Assembly& assembly, const Linkage& linkage);
// `plates`, with all that their way follows from. `placed`: where these are is known, too. Cost: that of what
// is walked, and linear in joints.
Walked walk_of(const std::vector<int>& plates, const std::vector<int>& placed, Linkage& linkage);

// Looks at every angle above the least opening, not only at some: between two angles no plate turns further
// than the bends of its linkage say. False, with an error that names the element and the angle, when a
// linkage cannot reach an angle (`locks`), or a plate is elsewhere within a millionth of a degree (`jumps`).
// `seen` is given the frames of what is placed at the least opening, and at each 72nd part of the sweep after
// it, one after the other. Cost: plates × (angles 5° of any plate's turning apart).
bool passes_whole_way(const Assembly& assembly, const Linkage& linkage, const Walked& walked,
                      Diagnostics& diagnostics,
                      const std::function<void(double deg, std::span<const Frame> frames)>& seen);

// The error of a linkage that gets to `reached` and not to `missed`. `reached` < 0: it gets nowhere.
void report_lock(const Joint& joint, double reached_deg, double missed_deg, Diagnostics& diagnostics);

}  // namespace popup
