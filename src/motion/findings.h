// What the examination found, as diagnostics.
#pragma once

#include <span>
#include <vector>

#include "motion/linkage.h"
#include "motion/plate_shape.h"
#include "popup/motion.h"

namespace popup {

// One warning for two elements that collide, for two that lie on one another, for an element that sticks out,
// for a closed card without an order of layers, for two elements that come too close; one remark for two that
// could not be told apart. Returns the moves that hints tell of, of collisions and of what lies on another.
std::vector<FreeingMove> report_findings(const Assembly& assembly, const Linkage& linkage,
                                         std::span<const PlateShape> shapes, const Examination& found,
                                         const MotionOptions& options, Diagnostics& diagnostics);

// One remark for each group of plates that the opening does not force, at the element of its first plate.
void report_not_forced(const Assembly& assembly, const Linkage& linkage, std::span<const FreePlates> all,
                       Diagnostics& diagnostics);

}  // namespace popup
