#include "output/tiled_pdf.h"

#include <cairo-pdf.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "base/text/numbers.h"
#include "output/cairo_sheet.h"
#include "output/page_texts.h"
#include "output/pdf_pages.h"
#include "output/tile_plan.h"

namespace popup {
namespace {

constexpr double kTileLabelMm = 1.6;  // height of capitals
constexpr double kNeighbourNameMm = 1.8;
constexpr double kScissorsMm = 2.6;
constexpr double kTileLineMm = 0.15;
// The line to cut along stands this far outside the tile, so that it covers nothing of the drawing.
constexpr double kCutOutsideMm = 0.1;
// Where things stand in the band next to the tile, measured from the tile.
constexpr double kMarkFromMm = 1.0, kMarkToMm = 4.5;
constexpr double kNeighbourAtMm = 1.8;
constexpr double kLabelAtMm = 4.1;
constexpr double kStripGrey = 0.5;
constexpr double kStripOpacity = 0.35;
constexpr double kTextGrey = 0.3;

std::size_t count_pages(const std::vector<SheetPart>& parts) {
    const auto bare = std::count_if(parts.begin(), parts.end(), [](const SheetPart& p) { return p.empty(); });
    return std::max<std::size_t>(parts.size() - static_cast<std::size_t>(bare), 1);
}

// The sheet's pages, all lying one way.
TiledSheet tiled(const SheetDrawing& drawing, const Box& area, const TileOptions& paper, bool across) {
    TiledSheet sheet;
    sheet.grid = tile_grid(area, paper, across);
    if (sheet.grid.tiles() > static_cast<double>(kMostTiles)) return sheet;
    sheet.parts = tile_parts(sheet.grid, drawing);
    sheet.pages = count_pages(sheet.parts);
    return sheet;
}

// One page of a sheet.
class TilePage {
 public:
    TilePage(cairo_t* context, const TiledSheet& sheet, int row, int column)
        : cairo_(context), sheet_(sheet), row_(row), column_(column) {
        const TileGrid& grid = sheet.grid;
        left_ = grid.left_mm();
        top_ = grid.top_mm();
        right_ = left_ + grid.width_mm;
        low_ = top_ + grid.height_mm;
    }

    void draw(PaintedPictures& pictures) {
        part(pictures);
        strips();
        joints();
        neighbours();
    }

    void label(std::string_view text) {
        grey(cairo_, kTextGrey);
        const double room = right_ - left_ - 2.0 * kTileOverlapMm - 4.0;
        write_fitting(cairo_, text, {0.5 * (left_ + right_), low_ + kLabelAtMm}, kTileLabelMm, room);
    }

 private:
    [[nodiscard]] bool lies_under_left() const { return sheet_.printed(row_, column_ - 1); }
    [[nodiscard]] bool lies_under_upper() const { return sheet_.printed(row_ - 1, column_); }
    [[nodiscard]] bool lies_over_right() const { return sheet_.printed(row_, column_ + 1); }
    [[nodiscard]] bool lies_over_lower() const { return sheet_.printed(row_ + 1, column_); }

    // Over the drawing, which is to be seen below, so that strips are found in areas of colour, too.
    void strips() {
        cairo_set_source_rgba(cairo_, kStripGrey, kStripGrey, kStripGrey, kStripOpacity);
        // As one path: where the strips cross, they are no darker.
        if (lies_under_left()) cairo_rectangle(cairo_, left_, top_, kTileOverlapMm, low_ - top_);
        if (lies_under_upper()) cairo_rectangle(cairo_, left_, top_, right_ - left_, kTileOverlapMm);
        cairo_set_fill_rule(cairo_, CAIRO_FILL_RULE_WINDING);
        cairo_fill(cairo_);
        grey(cairo_, kTextGrey);
        const double half = 0.5 * kTileOverlapMm;
        if (lies_under_left()) {
            write_turned(cairo_, "glue", {left_ + half, 0.5 * (top_ + low_)}, kTileLabelMm);
        }
        if (lies_under_upper()) {
            write(cairo_, "glue", {0.5 * (left_ + right_), top_ + half}, kTileLabelMm);
        }
    }

    void part(PaintedPictures& pictures) {
        const Box tile = sheet_.grid.tile(row_, column_);
        cairo_save(cairo_);
        cairo_rectangle(cairo_, left_, top_, right_ - left_, low_ - top_);
        cairo_clip(cairo_);
        cairo_translate(cairo_, left_ - tile.min.x, top_ - (sheet_.drawing.height_mm - tile.max.y));
        paint_part(cairo_, sheet_.drawing, sheet_.parts[sheet_.grid.index(row_, column_)], pictures);
        cairo_restore(cairo_);
    }

    void line(double x1, double y1, double x2, double y2) {
        cairo_move_to(cairo_, x1, y1);
        cairo_line_to(cairo_, x2, y2);
    }
    void stroke(std::span<const double> dashes) {
        cairo_set_dash(cairo_, dashes.data(), static_cast<int>(dashes.size()), 0.0);
        cairo_set_line_cap(cairo_, CAIRO_LINE_CAP_BUTT);
        cairo_set_line_width(cairo_, kTileLineMm);
        cairo_stroke(cairo_);
    }

    void joints() {
        grey(cairo_, kTextGrey);
        constexpr std::array kDashes{3.0, 2.0};
        const double cut_x = right_ + kCutOutsideMm;
        const double cut_y = low_ + kCutOutsideMm;
        if (lies_over_right()) line(cut_x, top_, cut_x, low_);
        if (lies_over_lower()) line(left_, cut_y, right_, cut_y);
        stroke(kDashes);
        // Beyond the tile's corners the lines go on whole, to lay a ruler on; so do the inner edges of
        // strips, on which the neighbour's edge comes to lie.
        const auto upright = [this](double x) {
            line(x, top_ - kMarkFromMm, x, top_ - kMarkToMm);
            line(x, low_ + kMarkFromMm, x, low_ + kMarkToMm);
        };
        const auto level = [this](double y) {
            line(left_ - kMarkFromMm, y, left_ - kMarkToMm, y);
            line(right_ + kMarkFromMm, y, right_ + kMarkToMm, y);
        };
        if (lies_over_right()) upright(right_);
        if (lies_under_left()) upright(left_ + kTileOverlapMm);
        if (lies_over_lower()) level(low_);
        if (lies_under_upper()) level(top_ + kTileOverlapMm);
        stroke({});
        // Scissors, at the end where one begins.
        if (lies_over_right()) write_turned(cairo_, "✂", {right_ + 1.8, low_ - 12.0}, kScissorsMm);
        if (lies_over_lower()) write(cairo_, "✂", {left_ + 12.0, low_ + 1.8}, kScissorsMm);
    }

    // Texts at the sides read from the right, so an arrow up in them points to the left.
    void neighbours() {
        const double x = 0.5 * (left_ + right_);
        const double y = 0.5 * (top_ + low_);
        if (lies_under_left())
            write_turned(cairo_, name(row_, column_ - 1, "↑"), {left_ - kNeighbourAtMm, y}, kNeighbourNameMm);
        if (lies_over_right())
            write_turned(cairo_, name(row_, column_ + 1, "↓"), {right_ + kNeighbourAtMm, y},
                         kNeighbourNameMm);
        if (lies_under_upper())
            write(cairo_, name(row_ - 1, column_, "↑"), {x, top_ - kNeighbourAtMm}, kNeighbourNameMm);
        if (lies_over_lower())
            write(cairo_, name(row_ + 1, column_, "↓"), {x, low_ + kNeighbourAtMm}, kNeighbourNameMm);
    }
    static std::string name(int row, int column, std::string_view arrow) {
        return fmt::format("{} {}", tile_name(row, column), arrow);
    }

    cairo_t* cairo_;
    const TiledSheet& sheet_;
    int row_, column_;
    double left_, top_, right_, low_;  // of the tile on the page
};

void begin_page(cairo_surface_t* surface, Vec2 mm) {
    cairo_pdf_surface_set_size(surface, mm.x * kPointsPerMm, mm.y * kPointsPerMm);
}

}  // namespace

bool TiledSheet::printed(int row, int column) const {
    if (row < 0 || column < 0 || row >= grid.rows || column >= grid.columns) return false;
    return whole() || !parts[grid.index(row, column)].empty();
}

std::optional<std::vector<TiledSheet>> tile_sheets(const Layout& layout, const OutputOptions& options,
                                                   std::span<const SheetView> views,
                                                   Diagnostics& diagnostics) {
    std::vector<TiledSheet> sheets;
    double tiles = 0.0;
    for (const SheetView& view : views) {
        SheetDrawing drawing = draw_sheet(layout, options, view);
        Box area = drawn_box(drawing);
        if (area.empty()) area = {{0.0, 0.0}, {0.0, 0.0}};
        TiledSheet upright = tiled(drawing, area, *options.tile, false);
        TiledSheet across = tiled(drawing, area, *options.tile, true);
        // One that has too many tiles has no pages.
        const bool is_across = across.pages > 0 && (upright.pages == 0 || across.pages < upright.pages);
        TiledSheet& chosen = sheets.emplace_back(std::move(is_across ? across : upright));
        tiles += chosen.grid.tiles();
        if (tiles > static_cast<double>(kMostTiles)) {
            const std::string what = sheets.size() == 1
                                         ? fmt::format("the sheet of {:.0f} × {:.0f} mm needs",
                                                       drawing.width_mm, drawing.height_mm)
                                         : fmt::format("the first {} sheets need", sheets.size());
            diagnostics
                .error("too-many-tiles", {},
                       fmt::format("{} {:.0f} pages of {} × {} mm; a document has at most {}", what, tiles,
                                   number_text(options.tile->width_mm, 1),
                                   number_text(options.tile->height_mm, 1), kMostTiles))
                .hint("give a larger paper with --tile, or a smaller --scale or --sheet");
            return std::nullopt;
        }
        chosen.drawing = std::move(drawing);
    }
    return sheets;
}

void show_tiles(cairo_surface_t* surface, cairo_t* context, std::span<const TiledSheet> sheets,
                const TileOptions& paper, PaintedPictures& pictures) {
    std::size_t pages = 0;
    std::size_t plans = 0;
    for (const TiledSheet& sheet : sheets) {
        plans += sheet.whole() ? 0 : 1;
        pages += sheet.pages;
    }
    pages += plans;
    std::size_t page = plans + 1;
    for (const TiledSheet& sheet : sheets) {
        if (!sheet.whole()) {
            begin_page(surface, plan_size(sheet, paper));
            draw_plan(context, sheet, paper, page, pictures);
            cairo_show_page(context);
        }
        page += sheet.pages;
    }
    page = plans + 1;
    for (const TiledSheet& sheet : sheets) {
        for (int row = 0; row < sheet.grid.rows; ++row) {
            for (int column = 0; column < sheet.grid.columns; ++column) {
                if (!sheet.printed(row, column)) continue;
                begin_page(surface, {sheet.grid.page_width_mm, sheet.grid.page_height_mm});
                TilePage one(context, sheet, row, column);
                one.draw(pictures);
                if (sheet.whole()) {
                    draw_whole_label(context, sheet, paper, page, pages);
                } else {
                    one.label(fmt::format("{} · row {} column {} · page {} of {}", sheet.drawing.title,
                                          row_name(row), column + 1, page, pages));
                }
                cairo_show_page(context);
                ++page;
            }
        }
    }
}

}  // namespace popup
