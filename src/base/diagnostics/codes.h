// The rows of code_table() about files that cannot be read or written.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> base_codes();

}  // namespace popup
