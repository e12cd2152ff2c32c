#include "base/text/text_width.h"

namespace popup {

double text_width(std::string_view text, double cap_height) {
    double width = 0.0;  // in heights of capitals
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if ((byte & 0xC0U) == 0x80U) continue;  // not the first byte of a character
        const bool wide =
            byte >= 0x80U || c == 'm' || c == 'w' || c == 'M' || c == 'W' || c == '@' || c == '%';
        const bool narrow = c == 'i' || c == 'j' || c == 'l' || c == 'I' || c == '.' || c == ':' || c == '\'';
        width += wide ? 1.4 : narrow ? 0.5 : 0.95;
    }
    return width * cap_height;
}

}  // namespace popup
