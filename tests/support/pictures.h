// Small pictures for tests, made here so that no file is needed.
#pragma once

#include <png.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>
// Needs <cstdio> before it.
#include <jpeglib.h>

namespace popup::test {

// Red, green; blue, white: each a quarter, red at the upper left. Four bytes a pixel; with `clear`, the white
// quarter is transparent.
inline std::vector<unsigned char> quarters(int width, int height, bool clear = false) {
    constexpr std::array<std::array<unsigned char, 3>, 4> kColors{
        {{255, 0, 0}, {0, 255, 0}, {0, 0, 255}, {255, 255, 255}}};
    std::vector<unsigned char> rgba;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const std::size_t quarter = (2 * y < height ? 0U : 2U) + (2 * x < width ? 0U : 1U);
            for (const unsigned char channel : kColors.at(quarter)) rgba.push_back(channel);
            rgba.push_back(clear && quarter == 3 ? 0 : 255);
        }
    }
    return rgba;
}

inline std::string png_of(int width, int height, bool clear = false) {
    const std::vector<unsigned char> rgba = quarters(width, height, clear);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(height);
    image.format = PNG_FORMAT_RGBA;
    png_alloc_size_t size = 0;
    png_image_write_to_memory(&image, nullptr, &size, 0, rgba.data(), 0, nullptr);
    std::string bytes(size, '\0');
    png_image_write_to_memory(&image, bytes.data(), &size, 0, rgba.data(), 0, nullptr);
    bytes.resize(size);
    return bytes;
}

// `components`: 3, or 4 of a picture in printers' colours.
inline std::string jpeg_of(int width, int height, int components = 3) {
    const std::vector<unsigned char> rgba = quarters(width, height);
    jpeg_compress_struct info{};
    jpeg_error_mgr errors{};
    info.err = jpeg_std_error(&errors);
    jpeg_create_compress(&info);
    unsigned char* data = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&info, &data, &size);
    info.image_width = static_cast<JDIMENSION>(width);
    info.image_height = static_cast<JDIMENSION>(height);
    info.input_components = components;
    info.in_color_space = components == 3 ? JCS_RGB : JCS_CMYK;
    jpeg_set_defaults(&info);
    jpeg_set_quality(&info, 95, TRUE);
    jpeg_start_compress(&info, TRUE);
    std::vector<unsigned char> row(static_cast<std::size_t>(width * components));
    while (info.next_scanline < info.image_height) {
        for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x) {
            for (std::size_t k = 0; k < static_cast<std::size_t>(components); ++k) {
                row[x * static_cast<std::size_t>(components) + k] =
                    rgba[4 * (static_cast<std::size_t>(width) * info.next_scanline + x) + k];
            }
        }
        JSAMPROW line = row.data();
        jpeg_write_scanlines(&info, &line, 1);
    }
    jpeg_finish_compress(&info);
    std::string bytes(reinterpret_cast<const char*>(data), size);
    jpeg_destroy_compress(&info);
    std::free(data);
    return bytes;
}

}  // namespace popup::test
