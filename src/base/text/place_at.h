// Where a byte of a text stands for those who read it in an editor.
#pragma once

#include <cstddef>
#include <string_view>

#include "popup/diagnostics.h"

namespace popup {

// Line and column of the byte, columns in characters. Precondition: offset ≤ text.size(). Cost: linear in
// offset.
Place place_at(std::string_view text, std::size_t offset);

}  // namespace popup
