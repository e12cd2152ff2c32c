#include "output/pdf.h"

#include <cairo-pdf.h>
#include <fmt/format.h>

#include <functional>

#include "output/cairo_sheet.h"
#include "output/pdf_pages.h"
#include "output/production_pdf.h"
#include "output/sheet_drawing.h"
#include "output/tiled_pdf.h"

namespace popup {
namespace {

// As Cairo wants a date, or nothing.
std::string creation_date() {
    const std::optional<std::tm> utc = source_date();
    if (!utc) return {};
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", utc->tm_year + 1900, utc->tm_mon + 1,
                       utc->tm_mday, utc->tm_hour, utc->tm_min, utc->tm_sec);
}

void set_metadata(cairo_surface_t* surface, const Layout& layout) {
    const auto set = [surface](cairo_pdf_metadata_t what, const std::string& text) {
        // Null takes away what Cairo puts there on its own: the present date.
        cairo_pdf_surface_set_metadata(surface, what, text.empty() ? nullptr : text.c_str());
    };
    set(CAIRO_PDF_METADATA_TITLE, layout_title(layout));
    set(CAIRO_PDF_METADATA_CREATOR, std::string(generator()));
    set(CAIRO_PDF_METADATA_CREATE_DATE, creation_date());
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
    static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

// Shows pages, setting their sizes. The context's unit is the millimetre.
using Pages = std::function<void(cairo_surface_t*, cairo_t*)>;

cairo_status_t draw_document(const Layout& layout, cairo_font_face_t* font, const Pages& pages,
                             std::string& bytes) {
    const LayoutSheet& first = layout.sheets.front();
    const Surface surface(cairo_pdf_surface_create_for_stream(append, &bytes, first.width_mm * kPointsPerMm,
                                                              first.height_mm * kPointsPerMm));
    set_metadata(surface.get(), layout);
    {
        const Context context(cairo_create(surface.get()));
        cairo_scale(context.get(), kPointsPerMm, kPointsPerMm);
        set_font(context.get(), font);
        pages(surface.get(), context.get());
        if (const cairo_status_t status = cairo_status(context.get()); status != CAIRO_STATUS_SUCCESS) {
            return status;
        }
    }
    cairo_surface_finish(surface.get());
    return cairo_surface_status(surface.get());
}

// A page a view.
void show_sheets(cairo_surface_t* surface, cairo_t* context, const Layout& layout,
                 const OutputOptions& options, std::span<const SheetView> views) {
    for (const SheetView& view : views) {
        const SheetDrawing drawing = draw_sheet(layout, options, view);
        cairo_pdf_surface_set_size(surface, drawing.width_mm * kPointsPerMm,
                                   drawing.height_mm * kPointsPerMm);
        paint_sheet(context, drawing);
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
        SheetFile& file = files.emplace_back();
        file.suffix = part.front().part_suffix;
        Pages pages = [&](cairo_surface_t* surface, cairo_t* context) {
            show_sheets(surface, context, layout, options, part);
        };
        std::optional<std::vector<TiledSheet>> sheets;
        if (options.tile) {
            sheets = tile_sheets(layout, options, part, diagnostics);
            if (!sheets) return std::nullopt;
            pages = [&](cairo_surface_t* surface, cairo_t* context) {
                show_tiles(surface, context, *sheets, *options.tile);
            };
        }
        const cairo_status_t status = draw_document(layout, font.get(), pages, file.bytes);
        if (status == CAIRO_STATUS_SUCCESS) continue;
        diagnostics.error("pdf-failed", {},
                          fmt::format("the PDF could not be made: {}", cairo_status_to_string(status)));
        return std::nullopt;
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
