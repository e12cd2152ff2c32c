// The rows of code_table() about profiles and kerf.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> fabrication_codes();

}  // namespace popup
