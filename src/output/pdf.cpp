#include "output/pdf.h"

#include <cairo-pdf.h>

#include "output/cairo_sheet.h"
#include "output/pdf_document.h"
#include "output/pdf_pages.h"
#include "output/production_pdf.h"
#include "output/sheet_drawing.h"
#include "output/tiled_pdf.h"

namespace popup {
namespace {

// A page a view.
void show_sheets(cairo_surface_t* surface, cairo_t* context, const Layout& layout,
                 const OutputOptions& options, std::span<const SheetView> views, PaintedPictures& pictures) {
    for (const SheetView& view : views) {
        const SheetDrawing drawing = draw_sheet(layout, options, view);
        cairo_pdf_surface_set_size(surface, drawing.width_mm * kPointsPerMm,
                                   drawing.height_mm * kPointsPerMm);
        paint_sheet(context, drawing, pictures);
        cairo_show_page(context);
    }
}

}  // namespace

std::optional<std::vector<SheetFile>> write_pdf_with_font(const Layout& layout, const OutputOptions& options,
                                                          const std::string& font_file,
                                                          Diagnostics& diagnostics) {
    if (!can_tile(options, diagnostics)) return std::nullopt;
    if (!(options.tile ? fits_page(options.tile->width_mm, options.tile->height_mm, diagnostics)
                       : fits_pages(layout, diagnostics)))
        return std::nullopt;
    const std::optional<std::vector<SheetView>> views = views_of(layout, options, diagnostics);
    if (!views) return std::nullopt;
    const FontFace font = open_font(font_file);
    if (font == nullptr) {
        report_missing_font(font_file, diagnostics);
        return std::nullopt;
    }
    std::vector<SheetFile> files;
    for (const std::span<const SheetView> part : parts_of(*views)) {
        PdfPages pages = [&](cairo_surface_t* surface, cairo_t* context, PaintedPictures& pictures) {
            show_sheets(surface, context, layout, options, part, pictures);
        };
        std::optional<std::vector<TiledSheet>> sheets;
        if (options.tile) {
            sheets = tile_sheets(layout, options, part, diagnostics);
            if (!sheets) return std::nullopt;
            pages = [&](cairo_surface_t* surface, cairo_t* context, PaintedPictures& pictures) {
                show_tiles(surface, context, *sheets, *options.tile, pictures);
            };
        }
        const LayoutSheet& first = layout.sheets.front();
        std::optional<std::string> document = draw_document(
            layout_title(layout), {first.width_mm, first.height_mm}, font.get(), pages, diagnostics);
        if (!document) return std::nullopt;
        files.push_back({part.front().part_suffix, std::move(*document)});
    }
    return files;
}

std::optional<std::vector<SheetFile>> write_pdf(const Layout& layout, const OutputOptions& options,
                                                Diagnostics& diagnostics) {
    // Tiles have no spot colours: what is asked for both is refused there.
    if (has_spot_colors(options.profile) && !options.tile)
        return write_production_pdf(layout, options, diagnostics);
    return write_pdf_with_font(layout, options, POPUP_FONT_FILE, diagnostics);
}

}  // namespace popup
