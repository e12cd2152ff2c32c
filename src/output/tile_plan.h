// The page that says how the pages of a tiled sheet go together.
#pragma once

#include <cairo.h>

#include <cstddef>

#include "output/tiled_pdf.h"

namespace popup {

// The plan's page: the paper, lying as the sheet does.
Vec2 plan_size(const TiledSheet& sheet, const TileOptions& paper);

// Draws the plan, inside the page's margin: title, what is printed and how it is glued, the sheet as large as
// there is room with the names of its tiles, the edges that are laid over others, and the numbers of their
// pages, of which the first is `first_page`; and a bar to measure. Tiles that are not printed are hatched.
void draw_plan(cairo_t* context, const TiledSheet& sheet, const TileOptions& paper, std::size_t first_page,
               PaintedPictures& pictures);

// What stands beside a sheet that is one page: its title and number below, the bar to measure above.
void draw_whole_label(cairo_t* context, const TiledSheet& sheet, const TileOptions& paper, std::size_t page,
                      std::size_t pages);

}  // namespace popup
