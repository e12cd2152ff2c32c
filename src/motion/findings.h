// What the examination found, as diagnostics.
#pragma once

#include "motion/linkage.h"
#include "popup/motion.h"

namespace popup {

// One warning for two elements that collide, for an element that sticks out, for a closed card without an
// order of layers, for two elements that come too close; one remark for two that could not be told apart.
void report_findings(const Assembly& assembly, const Linkage& linkage, const Examination& found,
                     const MotionOptions& options, Diagnostics& diagnostics);

}  // namespace popup
