// PNG and JPEG by their libraries, whose errors end in results.
#pragma once

#include <optional>
#include <string>

#include "popup/image.h"

namespace popup {

// How far a file was read. `pixels` is set where all of it could be.
struct Decoded {
    ImagePixels pixels;
    std::optional<ImageFault> fault;
};

// Precondition: the file begins as one of its format does. Never more than kMostImagePixels are kept.
Decoded decode_png(const std::string& file);
Decoded decode_jpeg(const std::string& file);

}  // namespace popup
