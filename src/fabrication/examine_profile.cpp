#include <fmt/format.h>

#include <array>
#include <cstddef>

#include "popup/diagnostics.h"
#include "popup/profile.h"

namespace popup {
namespace {

std::string counted(std::size_t n, std::string_view what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

}  // namespace

void examine_profile(const Layout& layout, const Profile& profile, Diagnostics& diagnostics) {
    std::array<std::size_t, kOperations.size()> found{};
    const auto count = [&found](Operation operation) -> std::size_t& {
        return found[static_cast<std::size_t>(operation)];
    };
    for (const Placement& placement : layout.placements) {
        const Pattern& pattern = layout.designs.at(static_cast<std::size_t>(placement.design)).pattern;
        const PatternPiece& piece = pattern.pieces.at(static_cast<std::size_t>(placement.piece));
        for (const PatternLine& line : piece.lines) ++count(operation_of(line, profile));
        for (const Contour& cut : piece.cuts) ++count(operation_of(cut));
    }
    std::size_t folds = 0;
    for (const Operation fold : {Operation::valley, Operation::mountain, Operation::seam}) {
        if (!profile.draws(fold) && !profile.perforates(fold)) folds += count(fold);
    }
    std::size_t cuts = 0;
    for (const Operation cut : {Operation::inner_cut, Operation::outer_cut}) {
        if (!profile.draws(cut)) cuts += count(cut);
    }
    if (folds > 0 || cuts > 0) {
        diagnostics
            .warning("lines-left-out", {},
                     fmt::format("the profile {} leaves out {}{}{}", profile.name,
                                 cuts > 0 ? counted(cuts, "cut") : "", cuts > 0 && folds > 0 ? " and " : "",
                                 folds > 0 ? counted(folds, "fold") : ""))
            .hint("give the pens of what is to be drawn a layer");
    }
    // Perforated lines fold either way.
    if (!profile.one_sided || profile.folds == FoldStyle::perforated) return;
    if (!profile.draws(Operation::mountain) || !profile.draws(Operation::valley)) return;
    const std::size_t mountains = count(Operation::mountain);
    const std::size_t valleys = count(Operation::valley);
    if (mountains == 0 || valleys == 0) return;
    diagnostics
        .remark(
            "one-sided-folds", {},
            fmt::format("the sheets have {} mountain and {}, and the profile {} scores all of them from the "
                        "front",
                        mountains, counted(valleys, "valley fold"), profile.name))
        .hint(
            "paper folds best away from its score: crease the valley folds by hand, or take --fold-style "
            "perforated, which folds either way");
}

}  // namespace popup
