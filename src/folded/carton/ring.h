// Walls of a dieline that a glue flap closes to a tube, and how far their folds must go for it.
#pragma once

#include <functional>
#include <string_view>
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
    bool hangs_open = false;  // the walls are a tube, and as their folds go they do not meet, or coil up
    std::string_view why;     // as ClosingAngles has it
};

// The longest row of parallel folds, all one way, the last of a glue flap, whose walls go around and come
// back to the first, with the ways in which they do, best first, as closing_angles() has them. Walls are a
// tube if nothing hangs on their ends, or what does has their widths for its sides: else they may be a tray.
// Empty: there is none, the drawing or the options say how far one of its folds goes, or they go so far
// already. Cost: that of make_sheet(), and linear in folds times walls.
std::vector<OpenRing> open_rings(const CreasePattern& pattern, const FoldOptions& options);

// Whether an assembly moves; what is found about that is in the diagnostics.
using Simulated = std::function<bool(Assembly&, Diagnostics&)>;

// The remark `ring-open` about a sheet that collides as it is folded, or of which a tube hangs open, where
// open_rings() finds walls that meet if their folds go as it says, and nothing is found about the sheet so
// folded and so simulated; other folds of 180° are tried at 90° before they are tried as they are. Cost: that
// of open_rings(), and where there is a ring that of folding and simulating the sheet up to six times.
void tell_open_ring(const CreasePattern& pattern, const FoldOptions& options, bool collides,
                    const Simulated& simulated, Diagnostics& diagnostics);

}  // namespace popup::folded
