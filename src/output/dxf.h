// Cut sheets as DXF, one document a sheet.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "popup/output.h"

namespace popup {

// One DXF document a sheet, of AutoCAD 2000 (AC1015) and in millimetres ($INSUNITS 4), origin at the sheet's
// lower left corner. A layer for each layer of the profile; each entity names its colour too: the nearest of
// the nine standard ones. Closed contours are closed LWPOLYLINEs, other paths open ones, single lines LINEs,
// labels TEXT; areas of colour are not drawn. Arcs, to 0.001 mm, are bulges of these polylines; a path with
// any other curve is one SPLINE of third degree, a row of Bézier curves that ends, when closed, where it
// begins. All in the order of the profile's operations. Folds are whole lines, whatever is dashed for the
// eye. Six decimals. What ASCII does not have is written \U+XXXX. Cost: linear in lines.
std::optional<std::vector<SheetFile>> write_dxf(const Layout& layout, const OutputOptions& options,
                                                Diagnostics& diagnostics);

}  // namespace popup
