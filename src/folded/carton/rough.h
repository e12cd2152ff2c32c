// The shape in which the motion of a sheet ends, for what refines it and looks for joins in it.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "folded/carton/folded_state.h"
#include "popup/refinement.h"

namespace popup::folded {

// Keeps what states refer to.
struct RoughShape {
    Sheet sheet;
    Tree tree;
    std::vector<double> angles;      // by fold, radians
    std::vector<std::string> names;  // by panel, "sheet/front"
    [[nodiscard]] FoldedState state() const { return {sheet, tree, angles}; }
    // Residuals up to this count as closed, mm.
    [[nodiscard]] double enough_mm() const { return kRefined * sheet.size(); }
};

// nullptr: the pattern is no sheet, or does not fold rigidly (`not-refined`).
std::unique_ptr<const RoughShape> rough_shape(const CreasePattern& pattern, const FoldOptions& options,
                                              Diagnostics& diagnostics);

// The fold that is furthest from its angle in the rough shape, by its angles, radians; of folds that are as
// far, the first.
FoldTurn furthest_turn(const RoughShape& rough, const std::vector<double>& angles);

// The sheet as cuts and folds of its own, these folded by certain angles, radians.
CreasePattern pattern_of(const CreasePattern& from, const RoughShape& rough,
                         const std::vector<double>& angles);

// The joins by numbers; nullopt: one names what is not there (`no-such-panel`).
std::optional<std::vector<PanelJoin>> resolve(const RoughShape& rough, std::span<const Join> joins,
                                              const CreasePattern& pattern, Diagnostics& diagnostics);

}  // namespace popup::folded
