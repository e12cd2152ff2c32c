// The rows of the codes that this room gives.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

std::span<const CodeInfo> trace_codes();

}  // namespace popup
