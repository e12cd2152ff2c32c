// The rows of code_table() about documents, and what drawings share with them.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> xml_codes();

}  // namespace popup
