// Finds the fold of an element that names none: the one that its outline crosses exactly twice.
#pragma once

#include <optional>
#include <vector>

#include "check/fold_index.h"
#include "check/placing.h"

namespace popup {

// What is there so far.
struct FoldsSoFar {
    const Skeleton& skeleton;
    const std::vector<Fold>& ghosts;
    const FoldIndex& index;
    const Design& design;
    const Tolerances& tolerances;

    [[nodiscard]] const Fold& fold_of(const FoldMatch& match) const {
        const auto number = static_cast<std::size_t>(match.fold);
        return match.ghost ? ghosts[number] : skeleton.folds[number];
    }
};

// The one fold that it is, along which `placing` then looks; what has been cut away of folds does not count.
// nullopt after an error: no-fold-crossed, which names what it crosses otherwise or what is near, or
// folds-crossed, which names them. Cost: linear in the folds whose lines come into the outline's box.
std::optional<FoldMatch> find_crossed(const FoldsSoFar& folds, const Structure& structure, Placing& placing,
                                      Diagnostics& diagnostics);

}  // namespace popup
