// The popup XML document as an input language.
#pragma once

#include <optional>
#include <string>

#include "popup/language.h"

namespace popup::xml {

// The rows' functions, as language.h promises them.
std::optional<Design> read(const Source& source, const ReadOptions& options, Diagnostics& diagnostics);
std::string patch(const Source& source, const Design& design);

// The limits of a page's width and height, mm.
inline constexpr double kSmallestPage = 1.0;
inline constexpr double kLargestPage = 10'000.0;
// The thickest drawn line, points.
inline constexpr double kThickestLine = 1000.0;

}  // namespace popup::xml
