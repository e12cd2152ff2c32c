// Pictures as they were seen, whichever way the camera was held.
#pragma once

#include <string>
#include <string_view>

#include "pictures/decode.h"
#include "popup/print.h"

namespace popup {

// How the rows of a file stand, as Exif counts it: 1 is upright, 3 upside down, 6 must be turned clockwise by
// a quarter and 8 the other way; 2, 4, 5 and 7 are mirrored, too. 1 where the file says nothing that is
// known. Precondition: the file was decoded without a fault.
int orientation_of(std::string_view file, ImageFormat format);

// The pixels of a picture with such an orientation, upright. Precondition: 1 to 8.
ImagePixels turned_upright(const ImagePixels& pixels, int orientation);

// A file of the same format that shows the picture upright and has no Exif; its colour profile stays. JPEG:
// without loss where its sides are whole blocks, else encoded anew. Empty: there is no memory for it.
// Precondition: `pixels` are those of the file, and its orientation is 2 to 8.
std::string upright_file(const std::string& file, ImageFormat format, const ImagePixels& pixels,
                         int orientation);

}  // namespace popup
