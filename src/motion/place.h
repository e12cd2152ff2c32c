// One joint's plates at one angle.
#pragma once

#include <span>

#include "popup/motion.h"

namespace popup {

// Places the plates of joint `index` from frames placed before; false when its linkage cannot reach the
// angle.
bool place_joint(const Assembly& assembly, std::size_t index, Angle theta, std::span<Frame> frames);

}  // namespace popup
