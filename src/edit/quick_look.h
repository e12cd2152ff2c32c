// Whether an edited document is as good as it was, without a look at all of it.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "popup/assembly.h"
#include "popup/check.h"
#include "popup/design.h"
#include "popup/diagnostics.h"

namespace popup::edit {

// How a card stands before it is edited.
struct Owners {
    std::vector<std::optional<std::size_t>> owners;  // of each structure: whose fold or plate it stands on
    bool as_written = false;                         // as of CardFolds
};
Owners owners_of(const CardFolds& card);

// What edits have made of a design.
struct Edits {
    const Design& before;
    const Design& after;
    std::optional<Owners> owners;  // `before`, where that is known; else it is found out when it is needed
};

// Of each structure of the edited design, its number before; none: it was added.
std::vector<std::optional<std::size_t>> numbers_before(const Design& before, const Design& after);

// The edited design as it will be read: rounded to what is written, with the names of what has no id.
Design as_read(Design design);

// Whether the edits have changed nothing but names and colours, which the checks do not look at.
bool is_as_it_was(const Edits& edits);

// Whether it is certain that nothing new is found in the edited design: the checks find nothing at all in it,
// as it will be read, and nothing is found about how its elements move that is not known from before.
// false: look at the document, and compare.
bool finds_nothing(Edits& edits, const CheckOptions& options);

// Whether it is certain that nothing is found about the motion of the edited design that was not found
// before. `checked` is what the checks have made of the edited design, or of what was read of it, and
// `assembly` is made of that. false: move all of it, and compare.
//
// The opening forces plates by loops, and what an element adds to loops, it adds to those of the elements
// that carry it. So those are moved that the edits have changed, added, or taken away, with all that carries
// or carried them and all that stands or stood on them: where nothing is found without the others, nothing is
// found with them. What a repair has moved was changed, too. The others move as before, if they did: before,
// there was nothing to repair, no error of a check, and none about the motion of these. Names and colours
// change nothing. Cost: linear in elements, a check of the design before, unless it is known, and a check and
// a motion of those elements before and after.
bool moves_without_findings(Edits& edits, const CheckedDesign& checked, std::span<const Diagnostic> repairs,
                            const Assembly& assembly, const CheckOptions& options);

}  // namespace popup::edit
