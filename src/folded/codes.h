// The rows of code_table() about folded sheets.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> folded_codes();

}  // namespace popup
