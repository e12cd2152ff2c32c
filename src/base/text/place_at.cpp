#include "base/text/place_at.h"

#include <algorithm>

namespace popup {
namespace {

// Bytes that continue a character do not count.
bool starts(char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }

}  // namespace

Place place_at(std::string_view text, std::size_t offset) {
    const std::string_view before = text.substr(0, offset);
    const std::size_t end = before.rfind('\n');
    const std::string_view line = end == std::string_view::npos ? before : before.substr(end + 1);
    return {1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')),
            1 + static_cast<int>(std::count_if(line.begin(), line.end(), starts))};
}

Place PlaceWalk::to(std::size_t offset) {
    for (; at_ < offset; ++at_) {
        if (text_[at_] == '\n') {
            ++place_.line;
            place_.column = 1;
        } else if (starts(text_[at_])) {
            ++place_.column;
        }
    }
    return place_;
}

}  // namespace popup
