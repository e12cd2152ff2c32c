// The rows of code_table() about inputs of any language.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> input_codes();

}  // namespace popup
