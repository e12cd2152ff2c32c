#include "output/png_rows.h"

#include <cstddef>
#include <string_view>

#include "base/system/picture_parts.h"

namespace popup {
namespace {

// The parts of the header behind its sizes (PNG specification, 11.2.2).
struct Header {
    int bits = 0;
    int colors = 0;  // 0 grey, 2 red, green and blue, 3 palette
    int interlaced = 0;
};

bool is_plain(const Header& header) {
    if (header.interlaced != 0) return false;
    if (header.colors == 2) return header.bits == 8;
    return (header.colors == 0 || header.colors == 3) && header.bits <= 8;
}

}  // namespace

std::optional<PngRows> png_rows(const Image& image) {
    constexpr std::size_t kHeader = 13;
    if (image.format != ImageFormat::png || image.bytes == nullptr) return std::nullopt;
    Header header;
    PngRows rows;
    for (const auto& [kind, whole, data] : png_chunks(*image.bytes)) {
        if (kind == "IHDR" && data.size() == kHeader) {
            header = {static_cast<unsigned char>(data[8]), static_cast<unsigned char>(data[9]),
                      static_cast<unsigned char>(data[12])};
            if (!is_plain(header)) return std::nullopt;
        } else if (kind == "tRNS") {
            return std::nullopt;
        } else if (kind == "PLTE" && header.colors == 3) {
            rows.palette = data;
        } else if (kind == "IDAT") {
            rows.bytes += data;
        } else if (kind == "IEND") {
            break;
        }
    }
    if (rows.bytes.empty()) return std::nullopt;
    rows.channels = header.colors == 2 ? 3 : 1;
    rows.bits = header.bits;
    // What a palette does not have is black to the library that decodes it.
    if (header.colors == 3) rows.palette.resize(std::size_t{3} << rows.bits, '\0');
    return rows;
}

}  // namespace popup
