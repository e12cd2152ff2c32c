// The rows of code_table() about DXF files.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> dxf_codes();

}  // namespace popup
