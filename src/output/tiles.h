// The pages on which a sheet is printed that is larger than the printer's paper: which part of the sheet each
// page shows. Coordinates are those of the sheet: millimetres, origin at the lower left corner, y up.
#pragma once

#include <cstddef>
#include <string>

#include "popup/geometry.h"
#include "popup/output.h"

namespace popup {

// What neighbouring pages both show, so that one can be laid over the other and glued.
inline constexpr double kTileOverlapMm = 5.0;
// Of the margin of a page, next to the drawing: where marks and labels stand. No margin is narrower.
inline constexpr double kTileBandMm = 5.0;
// What pages must have inside their margins, both ways.
inline constexpr double kLeastTileMm = 30.0;
// In one document.
inline constexpr std::size_t kMostTiles = 10000;

// Rows count from 0 at the top, columns from 0 at the left. All tiles are of one size, which is no larger
// than the page inside its margins: no page has a sliver, and those at the edges have as much as others.
struct TileGrid {
    Box area;  // what the tiles cover
    double page_width_mm = 0.0, page_height_mm = 0.0;
    double width_mm = 0.0, height_mm = 0.0;  // of a tile
    int columns = 1, rows = 1;

    // What a page shows. Neighbours have a strip of kTileOverlapMm in common.
    [[nodiscard]] Box tile(int row, int column) const;
    // What is seen of it when all is glued: without the strips at its left and its upper edge that neighbours
    // lie over. These boxes cover the area, and do not overlap.
    [[nodiscard]] Box seen(int row, int column) const;
    // Of a page's left and upper edge to its tile, which lies in the middle of the page.
    [[nodiscard]] double left_mm() const { return 0.5 * (page_width_mm - width_mm); }
    [[nodiscard]] double top_mm() const { return 0.5 * (page_height_mm - height_mm); }
    // As many as a grid has, those too on which nothing is drawn; more than an int can have.
    [[nodiscard]] double tiles() const { return static_cast<double>(columns) * rows; }
    [[nodiscard]] std::size_t index(int row, int column) const;
};

// The least rows and columns of pages, all upright or all across, that cover the area. Rows and columns are
// at most 10⁹ each, however large the area is. Precondition: can_tile() (popup/output.h).
TileGrid tile_grid(const Box& area, const TileOptions& paper, bool across);

// "B3": row B, column 3. Rows go on after Z with AA.
std::string row_name(int row);
std::string tile_name(int row, int column);

}  // namespace popup
