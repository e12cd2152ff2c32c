// The rows of code_table() about the command line, its configuration and its jobs.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> cli_codes();

}  // namespace popup
