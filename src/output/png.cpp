#include "output/png.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstddef>

namespace popup {
namespace {

constexpr double kInch = 25.4;

void append_bytes(png_structp png, png_bytep data, png_size_t length) {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), length);
}
void flush_nothing(png_structp /*png*/) {}

// The library leaves by longjmp when it fails; nothing with a destructor may live in this function.
bool encode_png(png_structp png, png_infop info, int height, const RowSource& row_of,
                std::vector<unsigned char>& row, double per_metre, std::string& bytes) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_write_fn(png, &bytes, append_bytes, flush_nothing);
    png_set_IHDR(png, info, static_cast<png_uint_32>(row.size() / 3U), static_cast<png_uint_32>(height), 8,
                 PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (per_metre > 0.0) {
        const auto unit = static_cast<png_uint_32>(std::lround(per_metre));
        png_set_pHYs(png, info, unit, unit, PNG_RESOLUTION_METER);
    }
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    // Drawings and models are plains of one colour: unfiltered rows pack a quarter smaller, in half the time.
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_NONE);
    png_write_info(png, info);
    for (int y = 0; y < height; ++y) {
        if (!row_of(y, row.data())) return false;
        png_write_row(png, row.data());
    }
    png_write_end(png, info);
    return true;
}

}  // namespace

bool to_png(int width, int height, const RowSource& row_of, std::optional<double> dpi, std::string& bytes) {
    std::vector<unsigned char> row(static_cast<std::size_t>(width) * 3U);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    const bool good = info != nullptr &&
                      encode_png(png, info, height, row_of, row, dpi.value_or(0.0) * 1000.0 / kInch, bytes);
    png_destroy_write_struct(&png, &info);
    return good;
}

bool to_png(const Pixels& pixels, std::optional<double> dpi, std::string& bytes) {
    const std::size_t row = static_cast<std::size_t>(pixels.width) * 3U;
    const auto copied = [&](int y, unsigned char* to) {
        std::copy_n(pixels.rgb.data() + static_cast<std::size_t>(y) * row, row, to);
        return true;
    };
    return to_png(pixels.width, pixels.height, copied, dpi, bytes);
}

}  // namespace popup
