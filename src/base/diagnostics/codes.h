// The rows of code_table() that no stage gives alone: files that cannot be read or written, and allowances.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> base_codes();

}  // namespace popup
