#include "base/text/shown.h"

#include <cstddef>

namespace popup {

std::string shown(std::string_view text) {
    constexpr std::size_t kLongest = 40;
    std::string out;
    std::size_t characters = 0;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if ((byte & 0xc0U) != 0x80 && ++characters > kLongest) return out + "...";
        out += byte < 0x20 || byte == 0x7f ? ' ' : c;
    }
    return out;
}

}  // namespace popup
