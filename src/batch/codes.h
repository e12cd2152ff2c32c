// The rows of code_table() about manifests.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> batch_codes();

}  // namespace popup
