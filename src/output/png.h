// Pixels as a PNG file.
#pragma once

#include <functional>
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

// The same of a picture that is never whole in memory: `row_of` is asked for each row once, from the top, and
// fills in three bytes a pixel. False also where it returns false.
using RowSource = std::function<bool(int y, unsigned char* row)>;
bool to_png(int width, int height, const RowSource& row_of, std::optional<double> dpi, std::string& bytes);

}  // namespace popup
