// The rows of code_table() about inputs that are programs.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> flatlang_codes();

}  // namespace popup
