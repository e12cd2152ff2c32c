#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "popup/diagnostics.h"
#include "popup/profile.h"

namespace popup {

void examine_profile(const Layout& layout, const Profile& profile, Diagnostics& diagnostics) {
    // Perforated lines fold either way.
    if (!profile.one_sided || profile.folds == FoldStyle::perforated) return;
    std::size_t mountains = 0;
    std::size_t valleys = 0;
    for (const Placement& placement : layout.placements) {
        const Pattern& pattern = layout.designs.at(static_cast<std::size_t>(placement.design)).pattern;
        for (const PatternLine& line : pattern.pieces.at(static_cast<std::size_t>(placement.piece)).lines) {
            if (line.kind == LineKind::mountain) ++mountains;
            if (line.kind == LineKind::valley) ++valleys;
        }
    }
    if (mountains == 0 || valleys == 0) return;
    diagnostics
        .remark(
            "one-sided-folds", {},
            fmt::format("the sheets have {} mountain and {} valley fold{}, and the profile {} scores all of "
                        "them from the front",
                        mountains, valleys, valleys == 1 ? "" : "s", profile.name))
        .hint(
            "paper folds best away from its score: crease the valley folds by hand, or take --fold-style "
            "perforated, which folds either way");
}

}  // namespace popup
