// Pixels as a PNG file.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace popup {

struct Pixels {
    int width = 0;
    int height = 0;
    std::vector<unsigned char> rgb;  // sRGB, rows from the top, three bytes a pixel
};

// False if there is no memory for it. `dpi`, which the file says; none: it says nothing. The same bytes with
// the same versions of libpng and zlib. Precondition: three bytes of `rgb` for each pixel.
bool to_png(const Pixels& pixels, std::optional<double> dpi, std::string& bytes);

}  // namespace popup
