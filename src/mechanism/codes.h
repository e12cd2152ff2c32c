// The rows of code_table() about elements: what each needs of its fold, its paper and its points.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> mechanism_codes();

}  // namespace popup
