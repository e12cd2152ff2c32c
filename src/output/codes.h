// The rows of code_table() about files that writers make.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> output_codes();

}  // namespace popup
