// A short stable name for a text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace popup {

// 16 hexadecimal digits: FNV-1a with 64 bits over the bytes, with the offset basis 0xcbf29ce484222325 and the
// prime 0x100000001b3 of G. Fowler, L. C. Noll and K.-P. Vo (IETF draft-eastlake-fnv). The same on every
// machine and in every version. It tells texts apart that differ by chance, not those that somebody made
// alike on purpose.
std::string fingerprint(std::string_view text);
std::uint64_t fingerprint_number(std::string_view text);  // the same as a number

}  // namespace popup
