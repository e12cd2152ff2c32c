#include "base/system/picture_parts.h"

namespace popup {

std::vector<PicturePart> png_chunks(std::string_view file) {
    constexpr std::size_t kSignature = 8;
    constexpr std::size_t kFrame = 12;  // of a chunk: its length, kind and checksum
    std::vector<PicturePart> parts;
    std::size_t at = kSignature;
    while (at + kFrame <= file.size()) {
        const std::size_t length = big_endian(file.substr(at, 4));
        if (length > file.size() - at - kFrame) break;
        const std::string_view whole = file.substr(at, length + kFrame);
        parts.push_back({whole.substr(4, 4), whole, whole.substr(8, length)});
        at += length + kFrame;
    }
    return parts;
}

std::size_t big_endian(std::string_view bytes) {
    std::size_t value = 0;
    for (const char byte : bytes) value = value << 8U | static_cast<unsigned char>(byte);
    return value;
}

}  // namespace popup
