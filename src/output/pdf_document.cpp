#include "output/pdf_document.h"

#include <cairo-pdf.h>
#include <fmt/format.h>

#include <stdexcept>

#include "base/diagnostics/render_diagnostics.h"
#include "output/cairo_sheet.h"
#include "output/pdf_pages.h"

namespace popup {
namespace {

// As Cairo wants a date, or nothing.
std::string creation_date() {
    const std::optional<std::tm> utc = source_date();
    if (!utc) return {};
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", utc->tm_year + 1900, utc->tm_mon + 1,
                       utc->tm_mday, utc->tm_hour, utc->tm_min, utc->tm_sec);
}

void set_metadata(cairo_surface_t* surface, const std::string& title) {
    const auto set = [surface](cairo_pdf_metadata_t what, const std::string& text) {
        // Null takes away what Cairo puts there on its own: the present date.
        cairo_pdf_surface_set_metadata(surface, what, text.empty() ? nullptr : text.c_str());
    };
    set(CAIRO_PDF_METADATA_TITLE, title);
    set(CAIRO_PDF_METADATA_CREATOR, std::string(generator()));
    set(CAIRO_PDF_METADATA_CREATE_DATE, creation_date());
}

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
    static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

cairo_status_t draw(const std::string& title, Vec2 first_page_mm, cairo_font_face_t* font,
                    const PdfPages& pages, PaintedPictures& pictures, std::string& bytes) {
    const Surface surface(cairo_pdf_surface_create_for_stream(append, &bytes, first_page_mm.x * kPointsPerMm,
                                                              first_page_mm.y * kPointsPerMm));
    set_metadata(surface.get(), title);
    {
        const Context context(cairo_create(surface.get()));
        cairo_scale(context.get(), kPointsPerMm, kPointsPerMm);
        set_font(context.get(), font);
        pages(surface.get(), context.get(), pictures);
        if (const cairo_status_t status = cairo_status(context.get()); status != CAIRO_STATUS_SUCCESS) {
            return status;
        }
    }
    cairo_surface_finish(surface.get());
    return cairo_surface_status(surface.get());
}

}  // namespace

std::optional<std::string> draw_document(const std::string& title, Vec2 first_page_mm,
                                         cairo_font_face_t* font, const PdfPages& pages,
                                         Diagnostics& diagnostics) {
    std::string bytes;
    PaintedPictures pictures(PaintedPictures::For::document);
    std::string why;
    const cairo_status_t status = draw(title, first_page_mm, font, pages, pictures, bytes);
    if (status != CAIRO_STATUS_SUCCESS) {
        why = cairo_status_to_string(status);
    } else {
        try {
            put_rows(pictures, bytes);
        } catch (const std::runtime_error& error) {
            why = visible(error.what());
        }
    }
    if (why.empty()) return bytes;
    diagnostics.error("pdf-failed", {}, fmt::format("the PDF could not be made: {}", why));
    return std::nullopt;
}

}  // namespace popup
