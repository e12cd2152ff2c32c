// What a hole through a whole sheet takes: of which plates, of which folds, and whether all holds together
// without it.
#pragma once

#include "check/fold_index.h"
#include "check/paper.h"
#include "check/plate_index.h"
#include "mechanism/element.h"

namespace popup {

// What is there so far.
struct Sheet {
    const Skeleton& skeleton;
    const PlateIndex& plates;
    const FoldIndex& folds;
    const PaperMap& paper;
    const Tolerances& tolerances;
};

// The ring is in page coordinates, counter-clockwise, and touches itself nowhere. It must lie on the page
// with paper around it, off seams and glued areas; each plate must stay one part, and each fold that it
// crosses keep a stretch of Tolerances::min_length_mm. Paper between it and another hole that tears is told
// of in Pierced::narrow. Cost: that of a look at what lies near it, where that is nothing but paper; else
// linear in the plates that lie near it, with their cut-outs.
Pierced pierce(const Sheet& sheet, int page, const Ring& ring);

}  // namespace popup
