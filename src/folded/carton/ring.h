// Walls of a dieline that a glue flap closes to a tube, and how far their folds must go for it.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "popup/assembly.h"
#include "popup/crease_pattern.h"
#include "popup/diagnostics.h"

namespace popup::folded {

// Folds side by side, with a wall between each and the next.
struct OpenRing {
    std::vector<int> lines;   // of the pattern, a line a fold, the glue flap's last
    std::vector<double> deg;  // how far each goes, (0, 180)
    double is_deg = 0.0;      // how far the first goes as it is
};

// The longest row of parallel folds, all one way, the last of a glue flap, whose walls go around and come
// back to the first: of n walls each fold goes by a share of 360°, where they then meet to a fiftieth of the
// way around; of three walls, each as the triangle has it. nullopt: there is none, the drawing or the options
// say how far one of its folds goes, or they go so far already. Cost: that of make_sheet(), and linear in
// folds times walls.
std::optional<OpenRing> open_ring(const CreasePattern& pattern, const FoldOptions& options);

// Whether an assembly moves; what is found about that is in the diagnostics.
using Simulated = std::function<bool(Assembly&, Diagnostics&)>;

// Of a sheet that collides as it is folded: the remark `ring-open` where open_ring() finds walls that meet if
// their folds go as it says, and nothing is found about the sheet so folded and so simulated; other folds of
// 180° are tried at 90° before they are tried as they are. Cost: that of open_ring(), and where there is a
// ring that of folding and simulating the sheet once or twice.
void tell_open_ring(const CreasePattern& pattern, const FoldOptions& options, const Simulated& simulated,
                    Diagnostics& diagnostics);

}  // namespace popup::folded
