// The rows of code_table() about FOLD files.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> fold_codes();

}  // namespace popup
