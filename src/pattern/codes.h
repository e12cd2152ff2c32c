// The rows of code_table() about flat pieces.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> pattern_codes();

}  // namespace popup
