// Sheets on pages of the printer's paper, which are glued together to the sheets.
#pragma once

#include <cairo.h>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "output/painted_pictures.h"
#include "output/sheet_drawing.h"
#include "output/tile_parts.h"
#include "output/tiles.h"

namespace popup {

// A sheet and its pages. A sheet that needs one page only has no plan and no joints.
struct TiledSheet {
    SheetDrawing drawing;
    TileGrid grid;                 // over what is drawn, not over the whole sheet
    std::vector<SheetPart> parts;  // by TileGrid::index(); a tile with nothing on it is not printed
    std::size_t pages = 0;         // at least 1
    [[nodiscard]] bool whole() const { return grid.tiles() <= 1.0; }
    [[nodiscard]] bool printed(int row, int column) const;  // false too where there is no such tile
};

// Each view on its pages. All pages of a sheet lie one way, upright unless fewer are needed across. Errors:
// `too-many-tiles`. Cost: that of drawing the sheets and of tile_parts(); all drawings are held in memory.
// Precondition: can_tile().
std::optional<std::vector<TiledSheet>> tile_sheets(const Layout& layout, const OutputOptions& options,
                                                   std::span<const SheetView> views,
                                                   Diagnostics& diagnostics);

// Shows the pages one by one on a PDF surface whose context has millimetres for its unit, y down, and the
// font of labels: first a plan of each sheet that needs several pages, then sheet by sheet the pages, from
// the upper left on. A page shows its tile in true size in its middle, cut off at the tile's edges, in its
// inner margin marks, its name and place, and the names of its neighbours; where a neighbour lies over it at
// the left or above it has a grey veil over that strip, and where it lies over a neighbour, at the
// right and below, a dashed line just outside the tile along which it is cut. A plan shows the sheet small,
// with its tiles, says what to do, and has a bar to measure; so has a page that is a whole sheet.
void show_tiles(cairo_surface_t* surface, cairo_t* context, std::span<const TiledSheet> sheets,
                const TileOptions& paper, PaintedPictures& pictures);

}  // namespace popup
