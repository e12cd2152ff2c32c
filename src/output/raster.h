// Cut sheets and pattern pages as pictures made of pixels.
#pragma once

#include <optional>
#include <vector>

#include "popup/output.h"

namespace popup {

// One PNG a sheet and side, RGB on white, `dpi` pixels an inch (which the file says, so that it prints in
// true size); widths and heights are rounded up to whole pixels. The same bytes with the same versions of
// Cairo, FreeType, libpng and zlib. Errors: `picture-too-large` (a side of more than 32767 pixels, or more
// than 300 million pixels in all), `font-missing`, `picture-failed`.
std::optional<std::vector<SheetFile>> write_png(const Layout& layout, const OutputOptions& options,
                                                Diagnostics& diagnostics);

// The pattern pages as Popup Workshop exports them: a JPEG of 800 × 650 pixels a piece, the middle of its
// page in the middle of the picture, 72 pixels an inch; of pieces that reach further, so many fewer that all
// of them is there. Lines are as the profile workshop draws them. Quality 92, no colours subsampled. The
// designs' pieces one after the other, each once, however many copies there are. Errors: `font-missing`,
// `picture-failed`.
std::optional<std::vector<SheetFile>> write_jpg(const Layout& layout, const OutputOptions& options,
                                                Diagnostics& diagnostics);

}  // namespace popup
