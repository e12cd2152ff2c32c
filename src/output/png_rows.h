// A PNG's picture as it stands in its file, compressed, for documents that read it so.
#pragma once

#include <optional>
#include <string>

#include "popup/image.h"

namespace popup {

struct PngRows {
    // A zlib stream of the rows from the top, each after the byte of its filter, as PDF reads with
    // /FlateDecode and /Predictor 15 (ISO 32000-1, 7.4.4.4).
    std::string bytes;
    int channels = 3;     // 3: red, green, blue; 1: grey, or a number in the palette
    int bits = 8;         // a channel: 1, 2, 4 or 8
    std::string palette;  // three bytes an entry, as many as `bits` can name; empty: none
};

// Nullopt where the file has them otherwise: with alpha or a clear colour, interlaced, 16 bits a channel, or
// no PNG. Their colours are those of pixels_of(). Precondition: open_image() made it. Cost: a copy.
std::optional<PngRows> png_rows(const Image& image);

}  // namespace popup
