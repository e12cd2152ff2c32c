// The examination with what it looks at made once.
#pragma once

#include <span>
#include <vector>

#include "motion/linkage.h"
#include "motion/plate_shape.h"
#include "motion/recall.h"
#include "popup/motion.h"

namespace popup {

// Of all plates, by number.
std::vector<PlateShape> plate_shapes(const Assembly& assembly);

// As examine(assembly, options) of popup/motion.h, from the assembly's linkage and shapes. `recall`: what an
// earlier one has left, and what this one leaves; null: nothing.
Examination examine(const Assembly& assembly, Linkage& linkage, std::span<const PlateShape> shapes,
                    const MotionOptions& options, Recall* recall = nullptr);

}  // namespace popup
