// Digests of bytes, by which files are told apart.
#pragma once

#include <string>
#include <string_view>

namespace popup {

// SHA-256 (FIPS 180-4) as 64 lower-case hexadecimal digits; what sha256sum(1) prints.
std::string sha256(std::string_view bytes);
// The same as its 32 bytes.
std::string sha256_bytes(std::string_view bytes);

}  // namespace popup
