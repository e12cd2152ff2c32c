// Where a byte of a text stands for those who read it in an editor.
#pragma once

#include <cstddef>
#include <string_view>

#include "popup/diagnostics.h"

namespace popup {

// Line and column of the byte, columns in characters. Precondition: offset ≤ text.size(). Cost: linear in
// offset.
Place place_at(std::string_view text, std::size_t offset);

// The same of many bytes, in ascending order: linear in the text for all of them.
//
//     PlaceWalk walk(text);
//     for (Face& face : faces) face.place = walk.to(face_begins);
class PlaceWalk {
 public:
    explicit PlaceWalk(std::string_view text) : text_(text) {}
    // Precondition: no less than the offset before, and ≤ text.size().
    Place to(std::size_t offset);

 private:
    std::string_view text_;
    std::size_t at_ = 0;
    Place place_{1, 1};
};

}  // namespace popup
