#include "output/jpeg.h"

// stdio first: the library's header needs it.
#include <jpeglib.h>

#include <csetjmp>
#include <cstdio>
#include <cstdlib>

namespace popup {
namespace {

// The library leaves by longjmp when it fails; nothing with a destructor may live in encode_jpeg().
struct JpegErrors {
    jpeg_error_mgr manager;
    std::jmp_buf back;
};

[[noreturn]] void leave(j_common_ptr info) {
    std::longjmp(reinterpret_cast<JpegErrors*>(info->err)->back, 1);
}

bool encode_jpeg(jpeg_compress_struct& info, JpegErrors& errors, const Pixels& pixels, int quality,
                 double dpi, unsigned char** data, unsigned long* size) {
    if (setjmp(errors.back) != 0) return false;
    jpeg_create_compress(&info);
    jpeg_mem_dest(&info, data, size);
    info.image_width = static_cast<JDIMENSION>(pixels.width);
    info.image_height = static_cast<JDIMENSION>(pixels.height);
    info.input_components = 3;
    info.in_color_space = JCS_RGB;
    jpeg_set_defaults(&info);
    jpeg_set_quality(&info, quality, TRUE);
    // Thin coloured lines on white would be smeared.
    info.comp_info[0].h_samp_factor = info.comp_info[0].v_samp_factor = 1;
    info.density_unit = 1;
    info.X_density = info.Y_density = static_cast<UINT16>(dpi);
    info.dct_method = JDCT_ISLOW;
    jpeg_start_compress(&info, TRUE);
    const std::size_t row = static_cast<std::size_t>(pixels.width) * 3U;
    while (info.next_scanline < info.image_height) {
        JSAMPROW line = const_cast<unsigned char*>(pixels.rgb.data()) + info.next_scanline * row;
        jpeg_write_scanlines(&info, &line, 1);
    }
    jpeg_finish_compress(&info);
    return true;
}

}  // namespace

bool to_jpeg(const Pixels& pixels, int quality, double dpi, std::string& bytes) {
    jpeg_compress_struct info{};
    JpegErrors errors{};
    info.err = jpeg_std_error(&errors.manager);
    errors.manager.error_exit = leave;
    unsigned char* data = nullptr;
    unsigned long size = 0;
    const bool good = encode_jpeg(info, errors, pixels, quality, dpi, &data, &size);
    if (good) bytes.assign(reinterpret_cast<const char*>(data), size);
    jpeg_destroy_compress(&info);
    std::free(data);
    return good;
}

}  // namespace popup
