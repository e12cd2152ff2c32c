// The rows of code_table() about pieces on sheets.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> layout_codes();

}  // namespace popup
