// Cut sheets as SVG, one document a sheet.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "popup/output.h"

namespace popup {

// One SVG document a sheet, 1 user unit = 1 mm, four decimals at most, no transforms but on text. Curves are
// cubics (C). Well-formed whatever the names. Layers that hold nothing are there all the same, so that
// programs can rely on them. Cost: linear in lines.
std::optional<std::vector<SheetFile>> write_svg(const Layout& layout, const OutputOptions& options,
                                                Diagnostics& diagnostics);

}  // namespace popup
