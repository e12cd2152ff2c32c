// What files of pictures consist of.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace popup {

// A chunk of a PNG, or a segment of a JPEG: what it is called, all of it, and what it holds. Views of the
// file.
struct PicturePart {
    std::string_view kind, whole, held;
};

// The chunks behind a PNG's signature, up to one that goes beyond the end of the file. Checksums are not
// looked at: who decodes the file does that.
std::vector<PicturePart> png_chunks(std::string_view file);

// A number of any width, its highest byte first.
std::size_t big_endian(std::string_view bytes);

}  // namespace popup
