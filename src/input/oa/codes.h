// The rows of code_table() about designs of webOAcard.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> oa_codes();

}  // namespace popup
