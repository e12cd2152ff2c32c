// How high the letters of the fonts are.
#pragma once

namespace popup {

// Height of the capitals of all DejaVu fonts as a part of the font size.
inline constexpr double kCapHeight = 1493.0 / 2048.0;

}  // namespace popup
