#include <csetjmp>
#include <cstdio>
// Needs <cstdio> before it.
#include <jpeglib.h>

#include "pictures/decode.h"

namespace popup {
namespace {

// Progressive pictures that people make have about ten scans; each costs as much as the whole picture.
constexpr int kMostScans = 200;

struct JpegErrors {
    jpeg_error_mgr manager;
    std::jmp_buf back;
};

[[noreturn]] void leave(j_common_ptr info) {
    std::longjmp(reinterpret_cast<JpegErrors*>(info->err)->back, 1);
}
void say_nothing(j_common_ptr /*info*/) {}
// The library goes on after data that is corrupt, and so would a broken picture pass for a whole one.
void leave_at_warnings(j_common_ptr info, int level) {
    if (level < 0) leave(info);
}
void count_scans(j_common_ptr info) {
    if (info->is_decompressor != 0 &&
        reinterpret_cast<j_decompress_ptr>(info)->input_scan_number > kMostScans) {
        leave(info);
    }
}

// All that has a destructor lives outside of this function.
bool decode(jpeg_decompress_struct& info, JpegErrors& errors, jpeg_progress_mgr& progress,
            const std::string& file, Decoded& result) {
    if (setjmp(errors.back) != 0) return false;
    jpeg_create_decompress(&info);
    progress.progress_monitor = count_scans;
    info.progress = &progress;
    jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(file.data()),
                 static_cast<unsigned long>(file.size()));
    jpeg_read_header(&info, TRUE);
    if (static_cast<double>(info.image_width) * info.image_height > static_cast<double>(kMostImagePixels)) {
        result.fault = ImageFault::too_many_pixels;
        return true;
    }
    if (info.num_components != 1 && info.num_components != 3) {
        result.fault = ImageFault::unsupported;
        return true;
    }
    info.out_color_space = JCS_RGB;
    info.dct_method = JDCT_ISLOW;
    jpeg_start_decompress(&info);
    result.pixels.width = static_cast<int>(info.output_width);
    result.pixels.height = static_cast<int>(info.output_height);
    const std::size_t pixels = std::size_t{info.output_width} * info.output_height;
    result.pixels.rgba.resize(4 * pixels);
    // Rows are read into the front of their place, three bytes a pixel, and spread from their end.
    while (info.output_scanline < info.output_height) {
        std::uint8_t* row =
            result.pixels.rgba.data() + std::size_t{4} * info.output_width * info.output_scanline;
        JSAMPROW line = row;
        jpeg_read_scanlines(&info, &line, 1);
        for (std::size_t x = info.output_width; x-- > 0;) {
            row[4 * x + 3] = 0xFF;
            row[4 * x + 2] = row[3 * x + 2];
            row[4 * x + 1] = row[3 * x + 1];
            row[4 * x] = row[3 * x];
        }
    }
    jpeg_finish_decompress(&info);
    return true;
}

}  // namespace

Decoded decode_jpeg(const std::string& file) {
    Decoded result;
    jpeg_decompress_struct info{};
    JpegErrors errors{};
    jpeg_progress_mgr progress{};
    info.err = jpeg_std_error(&errors.manager);
    errors.manager.error_exit = leave;
    errors.manager.output_message = say_nothing;
    errors.manager.emit_message = leave_at_warnings;
    const bool good = decode(info, errors, progress, file, result);
    jpeg_destroy_decompress(&info);
    if (!good) result.fault = ImageFault::broken;
    if (result.fault) result.pixels = {};
    return result;
}

}  // namespace popup
