#include "popup/image.h"

#include <atomic>
#include <memory>
#include <utility>

#include "pictures/decode.h"
#include "pictures/upright.h"
#include "popup/diagnostics.h"

namespace popup {
namespace {

std::optional<ImageFormat> format_of(std::string_view file) {
    if (file.starts_with("\x89PNG\r\n\x1a\n")) return ImageFormat::png;
    if (file.starts_with("\xff\xd8\xff")) return ImageFormat::jpeg;
    return std::nullopt;
}

Decoded decoded(const std::string& file, ImageFormat format) {
    return format == ImageFormat::png ? decode_png(file) : decode_jpeg(file);
}

// A file is decoded to be sure of it, and what shows it needs its pixels again. They are kept while those of
// all pictures there are take no more than this.
constexpr std::size_t kMostKeptBytes = std::size_t{64} << 20;
std::atomic<std::size_t> kept_bytes = 0;

// Null: there are too many.
std::shared_ptr<const ImagePixels> kept(ImagePixels pixels) {
    const std::size_t size = pixels.rgba.size();
    auto made = std::make_unique<const ImagePixels>(std::move(pixels));
    if (kept_bytes.fetch_add(size) + size > kMostKeptBytes) {
        kept_bytes -= size;
        return nullptr;
    }
    return {made.release(), [size](const ImagePixels* those) {
                delete those;
                kept_bytes -= size;
            }};
}

}  // namespace

std::string_view to_string(ImageFault fault) {
    switch (fault) {
        case ImageFault::not_an_image:
            return "the file is neither a PNG nor a JPEG";
        case ImageFault::broken:
            return "the picture is broken, or ends early";
        case ImageFault::unsupported:
            return "the picture is in printers' colours (CMYK)";
        case ImageFault::too_many_bytes:
            return "the file is larger than 64 MB";
        case ImageFault::too_many_pixels:
            return "the picture has more than 64 million pixels";
    }
    broken_invariant("an image fault is one of its enumerators", __FILE__, __LINE__);
}

std::variant<Image, ImageFault> open_image(std::string file) {
    if (file.size() > kMostImageBytes) return ImageFault::too_many_bytes;
    const std::optional<ImageFormat> format = format_of(file);
    if (!format) return ImageFault::not_an_image;
    Decoded picture = decoded(file, *format);
    if (picture.fault) return *picture.fault;
    if (const int orientation = orientation_of(file, *format); orientation != 1) {
        // What is shown is the file itself in some outputs and its pixels in others: both become upright.
        file = upright_file(file, *format, picture.pixels, orientation);
        picture = decoded(file, *format);
        if (picture.fault) return *picture.fault;
    }
    Image image;
    image.format = *format;
    image.width = picture.pixels.width;
    image.height = picture.pixels.height;
    image.place = {{1.0, 0.0}, {0.0, -1.0}, {0.0, 0.0}};
    image.bytes = std::make_shared<const std::string>(std::move(file));
    image.pixels = kept(std::move(picture.pixels));
    return image;
}

std::string_view mime_type(ImageFormat format) {
    return format == ImageFormat::png ? "image/png" : "image/jpeg";
}

std::optional<ImagePixels> pixels_of(const Image& image) {
    if (image.bytes == nullptr || format_of(*image.bytes) != image.format) return std::nullopt;
    if (image.pixels != nullptr) return *image.pixels;
    Decoded picture = decoded(*image.bytes, image.format);
    if (picture.fault || picture.pixels.width != image.width || picture.pixels.height != image.height) {
        return std::nullopt;
    }
    return std::move(picture.pixels);
}

bool may_be_transparent(const Image& image) {
    if (image.format == ImageFormat::jpeg || image.bytes == nullptr) return false;
    // The kind of colour stands in the header, which begins the file; bit 2 says that there is alpha. Other
    // pictures may say before their data which colours are clear.
    constexpr std::size_t kColorKind = 25;
    const std::string_view file = *image.bytes;
    if (file.size() <= kColorKind) return false;
    return (static_cast<unsigned char>(file[kColorKind]) & 4U) != 0 || file.find("tRNS") < file.find("IDAT");
}

Ring outline_of(const Image& image) {
    const double w = image.width;
    const double h = image.height;
    const Affine& place = image.place;
    Ring ring{place.point({0, 0}), place.point({w, 0}), place.point({w, h}), place.point({0, h})};
    if (signed_area(ring) < 0.0) ring = {ring[0], ring[3], ring[2], ring[1]};
    return ring;
}

std::vector<Polygon> shown_regions(const Image& image) {
    if (!image.clip.empty()) return image.clip;
    return {{outline_of(image), {}}};
}

}  // namespace popup
