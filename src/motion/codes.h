// The rows of code_table() about how a card opens and closes.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> motion_codes();

}  // namespace popup
