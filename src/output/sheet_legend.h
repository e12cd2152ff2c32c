// What a sheet says of itself: what its lines mean, how it is printed, and which side of it is up.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "fabrication/count_operations.h"
#include "output/sheet_drawing.h"

namespace popup {

inline constexpr double kLegendTextMm = 2.2;  // height of capitals

// Strokes of one look, or filled areas, in sheet coordinates.
struct LegendLine {
    std::vector<std::vector<Vec2>> strokes;
    Color color;
    double width_mm = 0.0;
    bool filled = false;
};
struct LegendText {
    std::string text;
    Vec2 at;  // its middle
};
struct LegendBox {
    Box bounds;
    std::vector<LegendLine> lines;
    std::vector<LegendText> texts;
};

// Whether anything that is counted is a fold or a place for glue.
bool is_folded_or_glued(const OperationCounts& counts);

// The legend of a sheet, with a row for each kind of line that its drawing has; nothing where no place inside
// the margins is free of pieces by 2 mm all round it, or, unless one is always wanted, where nothing of the
// layout is folded or glued. It lies as low as may be, then as far left. The lines of a machine's order need
// not be known yet. Cost: near linear in the outlines of pieces and in the cells of 2 mm that the sheet has,
// or fewer larger ones.
std::optional<LegendBox> legend_of(const SheetDrawing& drawing, const Layout& layout,
                                   std::span<const Placement> placements, const SheetView& view,
                                   const OutputOptions& options);

}  // namespace popup
