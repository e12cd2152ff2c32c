// Cards of a model at an opening angle.
#pragma once

#include <span>

#include "popup/diagnostics.h"
#include "popup/motion.h"

namespace popup {

// Between two cards of a model, where they are widest.
inline constexpr double kCardGapMm = 20.0;

// Places the plates in closed form. Where a linkage cannot reach the angle: false, and the error `locks`,
// about its joint.
bool place_card(const Assembly& assembly, double angle_deg, std::span<Frame> frames,
                Diagnostics& diagnostics);

}  // namespace popup
