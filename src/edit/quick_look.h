// Whether an edited document is as good as it was, without a look at all of it.
#pragma once

#include "popup/assembly.h"
#include "popup/check.h"
#include "popup/design.h"

namespace popup::edit {

// What edits have made of a design.
struct Edits {
    const Design& before;
    const Design& after;
    bool taken_out = false;  // of `before`, elements are gone
};

// Whether the checks find nothing at all in the edited design, as it will be written, and nothing about how
// its elements move that is not known from before. false: look at the document, and compare.
bool finds_nothing(const Edits& edits, const CheckOptions& options);

// Whether nothing is found about the motion of those elements that differ, with what carries them and what
// they carry: the others move as before. Where elements were taken out, all are moved: those may have held
// what they did not stand on. `read` is what was read of the edited design, or that itself, and `assembly` is
// made of it. false: move all of it, and compare. Cost: linear in elements, and a check and a motion of
// those.
bool moves_without_findings(const Edits& edits, const Design& read, const Assembly& assembly,
                            const CheckOptions& options);

}  // namespace popup::edit
