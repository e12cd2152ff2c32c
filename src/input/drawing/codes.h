// The rows of code_table() about drawings.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> drawing_codes();

}  // namespace popup
