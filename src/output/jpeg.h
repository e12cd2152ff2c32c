// Pixels as a JPEG file.
#pragma once

#include <string>

#include "output/png.h"

namespace popup {

// False if there is no memory for it. `quality`: 1 to 100. Colours are as fine as light: thin coloured lines
// on white would be smeared. The same bytes with the same version of libjpeg. Precondition: three bytes of
// `rgb` for each pixel.
bool to_jpeg(const Pixels& pixels, int quality, double dpi, std::string& bytes);

}  // namespace popup
