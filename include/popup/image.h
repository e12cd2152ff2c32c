// Pictures: from the bytes of a file to an Image, and to its pixels.
//
//   std::variant<Image, ImageFault> opened = open_image(bytes_of_a_file);
//   if (const auto* fault = std::get_if<ImageFault>(&opened)) report(to_string(*fault));
//   Image image = std::get<Image>(opened);
//   image.place = {{0.1, 0}, {0, -0.1}, {-40, 30}};  // ten pixels a millimetre, corner at (-40, 30)
//   plate.prints.push_back(image);
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "popup/print.h"

namespace popup {

inline constexpr std::size_t kMostImageBytes = std::size_t{64} << 20;
inline constexpr std::size_t kMostImagePixels = 64'000'000;

enum class ImageFault { not_an_image, broken, unsupported, too_many_bytes, too_many_pixels };
// What is wrong with the file: "the file is neither a PNG nor a JPEG".
std::string_view to_string(ImageFault fault);

// The picture of a whole PNG or JPEG file, not cut, a pixel a millimetre, its upper left corner at (0, 0) of
// the page. Guarantees of an Image: its file can be decoded to the end. A file that ends early, that a
// library complains of, or that is larger than the limits above, is a fault; so is one in printers' colours
// (CMYK). Where a camera says that it was held otherwise (Exif), the bytes become a file that is upright;
// all others stay as they are. Cost: that of decoding it, three times where it is turned.
std::variant<Image, ImageFault> open_image(std::string file);

// "image/png" or "image/jpeg".
std::string_view mime_type(ImageFormat format);

struct ImagePixels {
    int width = 0;
    int height = 0;
    bool opaque = true;              // every alpha is 255
    std::vector<std::uint8_t> rgba;  // rows from the top, four bytes a pixel, not premultiplied
};
// The pixels of an image, eight bits a channel, taken for sRGB. Nullopt only of images that open_image() did
// not make.
std::optional<ImagePixels> pixels_of(const Image& image);

// False of pictures that hide all that lies under them. Nothing is decoded for it: what may have holes may
// still have none.
bool may_be_transparent(const Image& image);

// Where the whole picture lies on its page: its corners, counter-clockwise.
Ring outline_of(const Image& image);
// What is to be seen of it: its clip, or the whole outline.
std::vector<Polygon> shown_regions(const Image& image);

}  // namespace popup
