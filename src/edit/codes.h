// Codes of what edits find.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

std::span<const CodeInfo> edit_codes();

}  // namespace popup
