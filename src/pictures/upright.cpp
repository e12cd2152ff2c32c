#include "pictures/upright.h"

#include <libexif/exif-data.h>
#include <png.h>
#include <turbojpeg.h>

#include <array>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "base/system/picture_parts.h"

namespace popup {
namespace {

constexpr std::string_view kExif{"Exif\0\0", 6};
constexpr std::string_view kProfile{"ICC_PROFILE\0", 12};
// Nobody sees the loss in print, and the file does not grow much.
constexpr int kQuality = 95;

// The segments before the first scan, but for the mark that begins the file. `kind` is their second byte.
std::vector<PicturePart> segments_of(std::string_view file) {
    std::vector<PicturePart> parts;
    std::size_t at = 2;
    while (at + 4 <= file.size() && file[at] == '\xff') {
        // Any number of these may come before a mark.
        if (file[at + 1] == '\xff') {
            ++at;
            continue;
        }
        const std::size_t length = 2 + big_endian(file.substr(at + 2, 2));
        if (file[at + 1] == '\xda' || length < 4 || length > file.size() - at) break;
        const std::string_view whole = file.substr(at, length);
        parts.push_back({whole.substr(1, 1), whole, whole.substr(4)});
        at += length;
    }
    return parts;
}

bool is_exif(const PicturePart& part) { return part.kind == "\xe1" && part.held.starts_with(kExif); }
bool is_profile(const PicturePart& part) { return part.kind == "\xe2" && part.held.starts_with(kProfile); }

// What Exif says, which begins with its name.
int orientation_in(const std::string& exif) {
    const std::unique_ptr<ExifData, decltype(&exif_data_unref)> data(exif_data_new(), exif_data_unref);
    if (data == nullptr) return 1;
    // It would put right what is not there.
    exif_data_unset_option(data.get(), EXIF_DATA_OPTION_FOLLOW_SPECIFICATION);
    exif_data_load_data(data.get(), reinterpret_cast<const unsigned char*>(exif.data()),
                        static_cast<unsigned int>(exif.size()));
    const ExifEntry* entry = exif_content_get_entry(data->ifd[EXIF_IFD_0], EXIF_TAG_ORIENTATION);
    if (entry == nullptr || entry->format != EXIF_FORMAT_SHORT || entry->size < 2) return 1;
    const int value = exif_get_short(entry->data, exif_data_get_byte_order(data.get()));
    return value >= 1 && value <= 8 ? value : 1;
}

bool swaps_sides(int orientation) { return orientation >= 5; }

struct TurboHandle {
    explicit TurboHandle(tjhandle made) : handle{made} {}
    TurboHandle(const TurboHandle&) = delete;
    TurboHandle& operator=(const TurboHandle&) = delete;
    ~TurboHandle() {
        if (handle != nullptr) tjDestroy(handle);
        tjFree(bytes);
    }
    tjhandle handle = nullptr;
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    [[nodiscard]] std::string file() const { return {reinterpret_cast<const char*>(bytes), size}; }
};

// Empty where sides are no whole blocks: blocks at an edge cannot go to the other side.
std::string turned_without_loss(const std::string& file, int orientation) {
    constexpr std::array<int, 9> kOperations{TJXOP_NONE,   TJXOP_NONE,       TJXOP_HFLIP,
                                             TJXOP_ROT180, TJXOP_VFLIP,      TJXOP_TRANSPOSE,
                                             TJXOP_ROT90,  TJXOP_TRANSVERSE, TJXOP_ROT270};
    TurboHandle turbo(tjInitTransform());
    if (turbo.handle == nullptr) return {};
    tjtransform transform{};
    transform.op = kOperations.at(static_cast<std::size_t>(orientation));
    transform.options = TJXOPT_PERFECT;
    if (tjTransform(turbo.handle, reinterpret_cast<const unsigned char*>(file.data()),
                    static_cast<unsigned long>(file.size()), 1, &turbo.bytes, &turbo.size, &transform,
                    0) != 0) {
        return {};
    }
    return turbo.file();
}

bool is_gray(const std::string& file) {
    const TurboHandle turbo(tjInitDecompress());
    int width = 0;
    int height = 0;
    int sampling = -1;
    int colors = -1;
    return turbo.handle != nullptr &&
           tjDecompressHeader3(turbo.handle, reinterpret_cast<const unsigned char*>(file.data()),
                               static_cast<unsigned long>(file.size()), &width, &height, &sampling,
                               &colors) == 0 &&
           colors == TJCS_GRAY;
}

std::string encoded_anew(const std::string& file, const ImagePixels& upright) {
    TurboHandle turbo(tjInitCompress());
    if (turbo.handle == nullptr ||
        tjCompress2(turbo.handle, upright.rgba.data(), upright.width, 0, upright.height, TJPF_RGBA,
                    &turbo.bytes, &turbo.size, is_gray(file) ? TJSAMP_GRAY : TJSAMP_444, kQuality,
                    TJFLAG_ACCURATEDCT) != 0) {
        return {};
    }
    std::string made = turbo.file();
    // Behind the segment of JFIF, which is the first.
    const std::vector<PicturePart> own = segments_of(made);
    std::size_t at = own.empty() ? 2 : 2 + own.front().whole.size();
    for (const PicturePart& part : segments_of(file)) {
        if (!is_profile(part)) continue;
        made.insert(at, part.whole);
        at += part.whole.size();
    }
    return made;
}

std::string upright_jpeg(const std::string& file, const ImagePixels& pixels, int orientation) {
    std::string bare = file;
    for (const PicturePart& part : segments_of(file)) {
        if (is_exif(part)) bare.erase(bare.find(part.whole), part.whole.size());
    }
    std::string made = turned_without_loss(bare, orientation);
    return made.empty() ? encoded_anew(file, turned_upright(pixels, orientation)) : made;
}

std::string upright_png(const std::string& file, const ImagePixels& pixels, int orientation) {
    const ImagePixels upright = turned_upright(pixels, orientation);
    constexpr std::size_t kColorKind = 25;
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(upright.width);
    image.height = static_cast<png_uint_32>(upright.height);
    // A profile of greys is for greys alone.
    const bool colored = (static_cast<unsigned char>(file.at(kColorKind)) & PNG_COLOR_MASK_COLOR) != 0;
    const std::size_t channels = colored ? 4 : 2;
    image.format = colored ? PNG_FORMAT_RGBA : PNG_FORMAT_GA;
    std::vector<std::uint8_t> bytes;
    bytes.reserve(upright.rgba.size() / 4 * channels);
    for (std::size_t i = 0; i < upright.rgba.size(); i += 4) {
        for (std::size_t k = 4 - channels; k < 4; ++k) bytes.push_back(upright.rgba[i + k]);
    }
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
    std::string made(size, '\0');
    if (png_image_write_to_memory(&image, made.data(), &size, 0, bytes.data(), 0, nullptr) == 0) return {};
    made.resize(size);
    // What colours are stands before the pixels; the library says sRGB by itself, which is taken out.
    std::string colors;
    for (const PicturePart& part : png_chunks(file)) {
        if (part.kind == "IDAT") break;
        if (part.kind == "iCCP" || part.kind == "sRGB" || part.kind == "gAMA" || part.kind == "cHRM")
            colors += part.whole;
    }
    std::string result = made.substr(0, 8);
    for (const PicturePart& part : png_chunks(made)) {
        if (part.kind == "sRGB" || part.kind == "gAMA" || part.kind == "cHRM") continue;
        result += part.whole;
        if (part.kind == "IHDR") result += colors;
    }
    return result;
}

}  // namespace

int orientation_of(std::string_view file, ImageFormat format) {
    for (const PicturePart& part : format == ImageFormat::jpeg ? segments_of(file) : png_chunks(file)) {
        // The first counts.
        if (format == ImageFormat::jpeg ? is_exif(part) : part.kind == "eXIf") {
            return orientation_in(format == ImageFormat::jpeg ? std::string(part.held)
                                                              : std::string(kExif).append(part.held));
        }
    }
    return 1;
}

ImagePixels turned_upright(const ImagePixels& pixels, int orientation) {
    ImagePixels upright;
    upright.opaque = pixels.opaque;
    const bool swaps = swaps_sides(orientation);
    upright.width = swaps ? pixels.height : pixels.width;
    upright.height = swaps ? pixels.width : pixels.height;
    upright.rgba.reserve(pixels.rgba.size());
    const bool from_right = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
    const bool from_below = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
    for (int y = 0; y < upright.height; ++y) {
        for (int x = 0; x < upright.width; ++x) {
            const int along = swaps ? y : x;
            const int down = swaps ? x : y;
            const int column = from_right ? pixels.width - 1 - along : along;
            const int row = from_below ? pixels.height - 1 - down : down;
            const auto at = pixels.rgba.begin() + 4 * (std::ptrdiff_t{row} * pixels.width + column);
            upright.rgba.insert(upright.rgba.end(), at, at + 4);
        }
    }
    return upright;
}

std::string upright_file(const std::string& file, ImageFormat format, const ImagePixels& pixels,
                         int orientation) {
    return format == ImageFormat::jpeg ? upright_jpeg(file, pixels, orientation)
                                       : upright_png(file, pixels, orientation);
}

}  // namespace popup
