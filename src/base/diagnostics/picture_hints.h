// What mends pictures that cannot be used: said by documents that name them, and by what reads them alone.
#pragma once

#include <string_view>

namespace popup {

inline constexpr std::string_view kPictureAnew = "export the picture anew, as a PNG or as a JPEG in RGB";
// Of pictures beyond kMostImagePixels or kMostImageBytes of popup/image.h.
inline constexpr std::string_view kPictureSmaller =
    "make the picture smaller: at most 64 million pixels, such as 8000 by 8000, and at most 64 MB";

}  // namespace popup
