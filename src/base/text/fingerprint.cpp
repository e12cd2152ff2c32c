#include "base/text/fingerprint.h"

#include <fmt/format.h>

namespace popup {

std::uint64_t fingerprint_number(std::string_view text) {
    std::uint64_t hash = 0xcbf29ce484222325U;
    for (const char c : text) {
        hash ^= static_cast<unsigned char>(c);
        hash *= 0x100000001b3U;
    }
    return hash;
}

std::string fingerprint(std::string_view text) { return fmt::format("{:016x}", fingerprint_number(text)); }

}  // namespace popup
