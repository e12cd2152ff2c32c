// Check: every constraint of every element, repaired where that can be done, and said where it was.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "popup/design.h"
#include "popup/mechanism.h"

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

// A fold or seam of a card, by the name that documents call it.
struct CardFold {
    std::string name;                  // "gutter", "bird.centre"
    std::optional<std::size_t> owner;  // the structure that makes it, by number; none: the page
    std::size_t which = 0;             // among the folds of its row
    PageFold at;                       // where check() has it
};

// What a structure stands on.
struct Standing {
    std::string on;  // "gutter", "bird.centre", "bird.left"; of a page "page 2"; empty: nothing
    std::optional<std::size_t> fold;   // a number of CardFolds::folds
    std::optional<std::size_t> owner;  // whose fold or plate it is; none: the page's
    // The fold in the coordinates of the structure's points, in the direction in which it names it; of a
    // plate or page the line upwards through the origin. For measures_of() and folds_of().
    PageFold seen;
};

struct CardFolds {
    std::vector<CardFold> folds;  // the gutter, then those of the structures, in their order
    std::vector<std::string> plates;
    std::vector<Standing> standing;  // one a structure
    bool as_written = false;         // check() finds no error, and repairs nothing
};

// All folds and plates of a design by their names, and what its structures stand on. A structure that cannot
// be made still has names, where its points tell where its folds would be. What can be repaired is, whatever
// the options say. Nothing is reported. Cost: that of check().
CardFolds folds_of_card(const Design& design, const Tolerances& tolerances = {});

// Structures that are dropped take the pages of their pieces with them: later pages move up, in everything
// that names one, and what is printed on a page that goes is dropped.
void close_up_pages(Design& design);

}  // namespace popup
