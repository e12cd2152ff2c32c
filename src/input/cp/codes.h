// The rows of code_table() about .cp files.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> cp_codes();

}  // namespace popup
