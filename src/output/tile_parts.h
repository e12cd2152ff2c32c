// What of a drawn sheet is on which of its tiles.
#pragma once

#include <cstddef>
#include <vector>

#include "output/sheet_drawing.h"
#include "output/tiles.h"

namespace popup {

// Some of a drawing's shapes and texts, by their indices, which ascend.
struct SheetPart {
    std::vector<std::size_t> shapes;
    std::vector<std::size_t> texts;
    [[nodiscard]] bool empty() const { return shapes.empty() && texts.empty(); }
};

// The box of all that is drawn, line widths counted, as far as it lies on the sheet; empty when nothing is.
Box drawn_box(const SheetDrawing& drawing);

// What is on each tile, by TileGrid::index(). A line is on the tiles that it crosses, not on all that its box
// meets, so a tile within a frame is empty; an area is on all tiles that it covers; a text on all that its
// box meets. Within 0.05 mm things may be on a tile that just do not reach it. Cost: linear in what is drawn
// and in the things on each tile. Precondition: the grid has at most kMostTiles.
std::vector<SheetPart> tile_parts(const TileGrid& grid, const SheetDrawing& drawing);

}  // namespace popup
