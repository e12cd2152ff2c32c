// The rows of code_table() about contours and the parts they make.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> parts_codes();

}  // namespace popup
