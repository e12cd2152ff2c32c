// The way of a whole assembly from closed to open: its linkages pass it, and its folds and seams stay closed.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "motion/linkage.h"
#include "motion/recall.h"
#include "popup/motion.h"

namespace popup {

struct WholeWay {
    std::vector<double> closed_at;  // those of the angles asked for that lay on the way, if all was closed
                                    // there; ascending, in degrees
    double most_open_mm = 0.0;      // the largest opening of a fold or seam there
};

// Takes everything through the sweep. nullopt, with the error of passes_whole_way(): it does not get through.
// `recall`: what moves as it did then has passed already, and is not walked again; null: all is walked. What
// this walk has found is kept there. The steps of a walk are as fine as what is walked needs, so a walk of
// little looks at fewer angles: what is out of reach for less than such a step, of which both ends can be
// reached and no fold passes flat in it, is found only where another mechanism is looked at in between. To
// look at the same angles would cost a placing of everything for each that one mechanism adds. Cost: that of
// passes_whole_way() for what is walked, and linear in hinges.
std::optional<WholeWay> pass_whole_way(const Assembly& assembly, Linkage& linkage,
                                       std::span<const Angle> asked, const Tolerances& tolerances,
                                       Recall* recall, Diagnostics& diagnostics);

}  // namespace popup
