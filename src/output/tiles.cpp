#include "output/tiles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text/numbers.h"
#include "output/production_pdf.h"

namespace popup {
namespace {

// A hair of room, so that a sheet as large as the page does not need two by rounding.
constexpr double kHair = 1e-6;

// How many tiles of at most `most` cover a length.
int count(double length, double most) {
    if (length <= most + kHair) return 1;
    const double needed = std::ceil((length - kTileOverlapMm - kHair) / (most - kTileOverlapMm));
    return static_cast<int>(std::clamp(needed, 2.0, 1e9));
}

double share(double length, int tiles) { return (length + (tiles - 1) * kTileOverlapMm) / tiles; }

bool refuse(Diagnostics& diagnostics, std::string message, std::string hint) {
    diagnostics.error("tiles-impossible", {}, std::move(message)).hint(std::move(hint));
    return false;
}

// What is made of the sheet later must bear that it is glued together.
bool goes_with_tiles(const OutputOptions& options, Diagnostics& diagnostics) {
    const Profile& profile = options.profile;
    if (options.print_and_cut) {
        return refuse(
            diagnostics,
            "--tile is for sheets that are glued together and cut by hand, and --print-and-cut for a "
            "machine, which needs its sheet in one piece",
            "leave out --tile, or --print-and-cut");
    }
    if (options.backs) {
        return refuse(diagnostics,
                      "--tile cannot have printed backs: where pages are glued, the margin of one covers the "
                      "back of the other",
                      "leave out --sides both, or print the sheet whole, without --tile");
    }
    if (options.score_side != ScoreSide::front) {
        return refuse(diagnostics,
                      "--tile prints fronts only, and --score-side puts lines on the back of the sheet",
                      "leave out --score-side, or --tile");
    }
    if (has_spot_colors(profile)) {
        return refuse(
            diagnostics,
            fmt::format("the profile \"{}\" has spot colours, for a shop that prints sheets whole: they "
                        "cannot be tiled",
                        profile.name),
            "leave out --tile, or take the profile workshop");
    }
    if (profile.machine_order) {
        return refuse(diagnostics,
                      fmt::format("the profile \"{}\" is for a machine, which needs its sheet in one piece: "
                                  "--tile is for sheets that are cut by hand",
                                  profile.name),
                      "leave out --tile, or take the profile workshop");
    }
    return true;
}

}  // namespace

bool can_tile(const OutputOptions& options, Diagnostics& diagnostics) {
    if (!options.tile) return true;
    if (!goes_with_tiles(options, diagnostics)) return false;
    const TileOptions& tile = *options.tile;
    if (tile.margin_mm < kTileBandMm) {
        diagnostics
            .error("tile-too-small", {},
                   fmt::format("a margin of {} mm has no room for the labels of tiles, which need {} mm",
                               number_text(tile.margin_mm, 3), kTileBandMm))
            .hint("give a wider --tile-margin");
        return false;
    }
    const double width = tile.width_mm - 2.0 * tile.margin_mm;
    const double height = tile.height_mm - 2.0 * tile.margin_mm;
    if (std::min(width, height) < kLeastTileMm - kHair) {
        const auto text = [](double mm) { return number_text(std::max(mm, 0.0), 1); };
        diagnostics
            .error("tile-too-small", {},
                   fmt::format("pages of {} × {} mm have {} × {} mm inside a margin of {} mm; tiles, which "
                               "overlap by {} mm, need {} mm each way",
                               text(tile.width_mm), text(tile.height_mm), text(width), text(height),
                               number_text(tile.margin_mm, 3), kTileOverlapMm, kLeastTileMm))
            .hint("give a larger paper with --tile, or a narrower --tile-margin");
        return false;
    }
    return true;
}

Box TileGrid::tile(int row, int column) const {
    // The outermost edges are those of the area to the last bit.
    const double left = area.min.x + column * (width_mm - kTileOverlapMm);
    const double top = area.max.y - row * (height_mm - kTileOverlapMm);
    return {{left, row + 1 == rows ? area.min.y : top - height_mm},
            {column + 1 == columns ? area.max.x : left + width_mm, top}};
}

Box TileGrid::seen(int row, int column) const {
    Box box = tile(row, column);
    if (column > 0) box.min.x = tile(row, column - 1).max.x;
    if (row > 0) box.max.y = tile(row - 1, column).min.y;
    return box;
}

std::size_t TileGrid::index(int row, int column) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
}

TileGrid tile_grid(const Box& area, const TileOptions& paper, bool across) {
    TileGrid grid;
    grid.area = area;
    const auto [narrow, wide] = std::minmax({paper.width_mm, paper.height_mm});
    grid.page_width_mm = across ? wide : narrow;
    grid.page_height_mm = across ? narrow : wide;
    grid.columns = count(area.width(), grid.page_width_mm - 2.0 * paper.margin_mm);
    grid.rows = count(area.height(), grid.page_height_mm - 2.0 * paper.margin_mm);
    grid.width_mm = share(area.width(), grid.columns);
    grid.height_mm = share(area.height(), grid.rows);
    return grid;
}

std::string row_name(int row) {
    std::string name;
    for (int left = row; left >= 0; left = left / 26 - 1)
        name.insert(name.begin(), static_cast<char>('A' + left % 26));
    return name;
}

std::string tile_name(int row, int column) { return fmt::format("{}{}", row_name(row), column + 1); }

}  // namespace popup
