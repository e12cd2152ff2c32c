// The rows of code_table() about assemblies that are read.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> assembly_codes();

}  // namespace popup
