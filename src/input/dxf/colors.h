// The numbers that AutoCAD gives to colours.
#pragma once

#include "popup/print.h"

namespace popup::dxf {

inline constexpr int kByBlock = 0;
inline constexpr int kByLayer = 256;
// What is drawn black on white paper, and white on a black screen.
inline constexpr int kForeground = 7;

// The colour of an index from 1 to 255; black for any other.
Color index_color(int index);

}  // namespace popup::dxf
