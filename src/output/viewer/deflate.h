// Bytes packed as RFC 1950 (zlib) has it.
#pragma once

#include <string>
#include <string_view>

namespace popup {

// The bytes, packed; the same with the same version of zlib. Cost: linear.
std::string deflated(std::string_view bytes);

}  // namespace popup
