// The rows of code_table() about drawings that are cards.
#pragma once

#include <span>

#include "popup/diagnostics.h"

namespace popup {

// Sorted by code.
std::span<const CodeInfo> drawn_card_codes();

}  // namespace popup
