// The rows of code_table() about repairs that are asked for.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> repair_codes();

}  // namespace popup
