// Check: every constraint of every element, repaired where that can be done, and said where it was.
#pragma once

#include <memory>
#include <optional>

#include "popup/design.h"

namespace popup {

struct Skeleton;  // plates, lines and joints as the elements lowered them; src/mechanism/builder.h

// A design whose constraints all hold. Only check() makes one.
class CheckedDesign {
 public:
    // The document as it should be written: the author's numbers, but for what a repair has changed.
    [[nodiscard]] const Design& design() const { return design_; }
    // What the elements became, with exact coordinates.
    [[nodiscard]] const Skeleton& skeleton() const { return *skeleton_; }

 private:
    friend struct Checker;
    CheckedDesign(Design design, std::shared_ptr<const Skeleton> skeleton)
        : design_(std::move(design)), skeleton_(std::move(skeleton)) {}
    Design design_;
    std::shared_ptr<const Skeleton> skeleton_;
};

struct CheckOptions {
    bool repair = true;  // false: what would be repaired is an error
    bool drop = false;   // degenerate elements, and what stands on them, are taken out (`fix --drop`)
    Tolerances tolerances;
};

// Walks the build order; each element is placed on its fold, constrained, repaired by the least change, and
// lowered before the elements that stand on it are looked at. Children keep their place relative to a fold
// that moved. Every repair is a diagnostic with its change. nullopt when anything could not be repaired; all
// findings are collected first, and an element that stands on a broken one is not complained about again.
// Cost: near linear in elements (folds and paper edges are found through a spatial index).
std::optional<CheckedDesign> check(const Design& design, const CheckOptions& options,
                                   Diagnostics& diagnostics);

}  // namespace popup
