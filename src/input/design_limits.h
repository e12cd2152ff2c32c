// What a design may hold, whatever language it is written in.
#pragma once

#include <cstddef>

namespace popup {

// Longer lists of structures or of drawn lines are refused, to bound the memory.
inline constexpr std::size_t kItemsLimit = 250'000;
// More points than this in one document are refused, likewise.
inline constexpr std::size_t kPointsLimit = 1'000'000;
// Pages beyond this are mistakes.
inline constexpr int kPageLimit = 1'000'000;
// Coordinates further out than this, in mm, are mistakes.
inline constexpr double kCoordinateLimit = 1e6;
// The limits of a page's width and height, mm.
inline constexpr double kSmallestPage = 1.0;
inline constexpr double kLargestPage = 10'000.0;
// How far a card opens, degrees.
inline constexpr double kLeastOpening = 1.0;
inline constexpr double kWholeOpening = 180.0;
// The thickest drawn line, points.
inline constexpr double kThickestLine = 1000.0;

}  // namespace popup
