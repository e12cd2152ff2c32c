// The rows of code_table() about a run as a whole.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> run_codes();

}  // namespace popup
