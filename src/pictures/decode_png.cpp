#include <png.h>

#include <algorithm>
#include <csetjmp>
#include <cstring>
#include <vector>

#include "pictures/decode.h"

namespace popup {
namespace {

struct PngSource {
    const std::string* file = nullptr;
    std::size_t read = 0;
};

void read_bytes(png_structp png, png_bytep data, png_size_t length) {
    auto* source = static_cast<PngSource*>(png_get_io_ptr(png));
    if (length > source->file->size() - source->read) png_error(png, "the file ends early");
    std::memcpy(data, source->file->data() + source->read, length);
    source->read += length;
}

void say_nothing(png_structp /*png*/, png_const_charp /*message*/) {}
[[noreturn]] void leave(png_structp png, png_const_charp /*message*/) { png_longjmp(png, 1); }

// The library leaves by longjmp when it fails: all that has a destructor lives outside of this function.
bool decode(png_structp png, png_infop info, PngSource& source, Decoded& result,
            std::vector<png_bytep>& rows) {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_read_fn(png, &source, read_bytes);
    png_read_info(png, info);
    const png_uint_32 width = png_get_image_width(png, info);
    const png_uint_32 height = png_get_image_height(png, info);
    if (static_cast<double>(width) * height > static_cast<double>(kMostImagePixels)) {
        result.fault = ImageFault::too_many_pixels;
        return true;
    }
    // Only alpha of its own, or a colour that is said to be clear, makes a picture other than opaque.
    result.pixels.opaque = (png_get_color_type(png, info) & PNG_COLOR_MASK_ALPHA) == 0 &&
                           png_get_valid(png, info, PNG_INFO_tRNS) == 0;
    png_set_expand(png);
    png_set_scale_16(png);
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 0xFF, PNG_FILLER_AFTER);
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    result.pixels.width = static_cast<int>(width);
    result.pixels.height = static_cast<int>(height);
    const std::size_t stride = png_get_rowbytes(png, info);
    if (stride != std::size_t{4} * width) return false;
    result.pixels.rgba.resize(stride * height);
    rows.resize(height);
    for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = result.pixels.rgba.data() + y * stride;
    png_read_image(png, rows.data());
    png_read_end(png, nullptr);
    return true;
}

}  // namespace

Decoded decode_png(const std::string& file) {
    Decoded result;
    PngSource source{&file, 0};
    std::vector<png_bytep> rows;
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, leave, say_nothing);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    const bool good = info != nullptr && decode(png, info, source, result, rows);
    png_destroy_read_struct(&png, &info, nullptr);
    if (!good) result.fault = ImageFault::broken;
    if (result.fault) {
        result.pixels = {};
        return result;
    }
    if (result.pixels.opaque) return result;
    const std::vector<std::uint8_t>& rgba = result.pixels.rgba;
    std::size_t i = 3;
    while (i < rgba.size() && rgba[i] == 0xFF) i += 4;
    result.pixels.opaque = i >= rgba.size();
    return result;
}

}  // namespace popup
