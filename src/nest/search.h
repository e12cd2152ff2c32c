// The search for one layout of all items at once.
#pragma once

#include "popup/nest.h"

namespace popup {

// What nest() promises, for up to a few thousand items; `work` is the whole effort, in units.
NestResult search(const NestJob& job, const NestEffort& effort, double work);

}  // namespace popup
