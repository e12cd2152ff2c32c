// The rows of code_table() about findings kept from other runs.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> findings_codes();

}  // namespace popup
