// The rows of code_table() about how the elements of a design stand on each other.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> check_codes();

}  // namespace popup
