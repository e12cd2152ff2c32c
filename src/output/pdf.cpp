#include "output/pdf.h"

#include <cairo-ft.h>
#include <cairo-pdf.h>
#include <cairo.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <string_view>

#include "output/sheet_drawing.h"

namespace popup {
namespace {

constexpr double kPointsPerMm = 72.0 / 25.4;
constexpr double kLargestPageMm = 5080.0;  // 14400 points; ISO 32000-1, annex C.2

template <auto release>
struct Release {
    template <typename T>
    void operator()(T* thing) const {
        release(thing);
    }
};
using Surface = std::unique_ptr<cairo_surface_t, Release<cairo_surface_destroy>>;
using Context = std::unique_ptr<cairo_t, Release<cairo_destroy>>;
using FontFace = std::unique_ptr<cairo_font_face_t, Release<cairo_font_face_destroy>>;
using FontOptions = std::unique_ptr<cairo_font_options_t, Release<cairo_font_options_destroy>>;

// The font file as FreeType has it. Cairo keeps font faces in its cache after their last user has gone, so it
// is the face that owns this and gives it back.
struct FontFile {
    FT_Library library = nullptr;
    FT_Face face = nullptr;
    FontFile() = default;
    FontFile(const FontFile&) = delete;
    FontFile& operator=(const FontFile&) = delete;
    ~FontFile() {
        if (face != nullptr) FT_Done_Face(face);
        if (library != nullptr) FT_Done_FreeType(library);
    }
};

// Null when the file cannot be read as a font.
FontFace open_font(const std::string& file) {
    static const cairo_user_data_key_t kOwner{};
    auto owned = std::make_unique<FontFile>();
    if (FT_Init_FreeType(&owned->library) != 0) return nullptr;
    if (FT_New_Face(owned->library, file.c_str(), 0, &owned->face) != 0) return nullptr;
    FontFace font(cairo_ft_font_face_create_for_ft_face(owned->face, FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP));
    const auto give_back = [](void* data) { delete static_cast<FontFile*>(data); };
    if (cairo_font_face_set_user_data(font.get(), &kOwner, owned.get(), give_back) != CAIRO_STATUS_SUCCESS) {
        return nullptr;
    }
    static_cast<void>(owned.release());
    return font;
}

// Seconds of SOURCE_DATE_EPOCH as Cairo wants a date, or nothing.
std::string source_date() {
    const char* text = std::getenv("SOURCE_DATE_EPOCH");
    if (text == nullptr) return {};
    const std::string_view digits = text;
    long long seconds = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), seconds);
    constexpr long long kYear10000 = 253402300800;
    if (error != std::errc() || end != digits.data() + digits.size()) return {};
    if (seconds < 0 || seconds >= kYear10000) return {};
    const auto when = static_cast<std::time_t>(seconds);
    std::tm utc{};
    gmtime_r(&when, &utc);
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", utc.tm_year + 1900, utc.tm_mon + 1,
                       utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec);
}

void set_metadata(cairo_surface_t* surface, const Layout& layout) {
    const auto set = [surface](cairo_pdf_metadata_t what, const std::string& text) {
        // Null takes away what Cairo puts there on its own: the present date.
        cairo_pdf_surface_set_metadata(surface, what, text.empty() ? nullptr : text.c_str());
    };
    set(CAIRO_PDF_METADATA_TITLE, layout_title(layout));
    set(CAIRO_PDF_METADATA_CREATOR, std::string(generator()));
    set(CAIRO_PDF_METADATA_CREATE_DATE, source_date());
}

// One page; the context's unit is the millimetre, y down from the upper edge.
class PdfPage {
 public:
    PdfPage(cairo_t* context, const SheetDrawing& drawing, const Profile& profile)
        : cairo_(context), drawing_(drawing), profile_(profile) {}

    void draw() {
        for (const SheetLayer& layer : layers_of(profile_)) {
            for (const SheetPiece& piece : drawing_.pieces) {
                for (const SheetShape& one : drawing_.shapes_of(piece, layer.first, layer.last)) shape(one);
            }
            if (layer.first > Operation::label || layer.last < Operation::label) continue;
            color(profile_.pen(Operation::label).color);
            for (const SheetText& one : drawing_.texts) text(one);
        }
    }

 private:
    void color(Color c) { cairo_set_source_rgb(cairo_, c.r / 255.0, c.g / 255.0, c.b / 255.0); }

    void trace(const SheetShape& shape) {
        for (const Run& run : drawing_.runs_of(shape)) {
            cairo_new_sub_path(cairo_);
            for (const Vec2 p : drawing_.points_of(run)) {
                cairo_line_to(cairo_, p.x, drawing_.height_mm - p.y);
            }
            if (run.closed) cairo_close_path(cairo_);
        }
    }

    void shape(const SheetShape& shape) {
        color(shape.color);
        trace(shape);
        if (shape.operation == Operation::fill) {
            cairo_set_fill_rule(cairo_, CAIRO_FILL_RULE_EVEN_ODD);
            cairo_fill(cairo_);
            return;
        }
        const bool whole = !profile_.dashes(shape.operation);
        cairo_set_line_cap(cairo_, whole ? CAIRO_LINE_CAP_ROUND : CAIRO_LINE_CAP_BUTT);
        cairo_set_line_join(cairo_, whole ? CAIRO_LINE_JOIN_ROUND : CAIRO_LINE_JOIN_MITER);
        const Dashes dashes = whole ? Dashes{} : fitted_dashes(shape.operation, drawing_.length_of(shape));
        cairo_set_dash(cairo_, dashes.mm.data(), static_cast<int>(dashes.count), 0.0);
        cairo_set_line_width(cairo_, shape.width_mm);
        cairo_stroke(cairo_);
    }

    void text(const SheetText& text) {
        cairo_save(cairo_);
        cairo_translate(cairo_, text.at.x, drawing_.height_mm - text.at.y);
        cairo_rotate(cairo_, -text.angle);
        cairo_set_font_size(cairo_, text.cap_mm / kCapHeight);
        cairo_text_extents_t extents{};
        cairo_text_extents(cairo_, text.text.c_str(), &extents);
        cairo_move_to(cairo_, -0.5 * extents.x_advance, 0.5 * text.cap_mm);
        cairo_show_text(cairo_, text.text.c_str());
        cairo_restore(cairo_);
        cairo_new_path(cairo_);
    }

    cairo_t* cairo_;
    const SheetDrawing& drawing_;
    const Profile& profile_;
};

cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
    static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
}

cairo_status_t draw_document(const Layout& layout, const Profile& profile, cairo_font_face_t* font,
                             std::string& bytes) {
    const LayoutSheet& first = layout.sheets.front();
    const Surface surface(cairo_pdf_surface_create_for_stream(append, &bytes, first.width_mm * kPointsPerMm,
                                                              first.height_mm * kPointsPerMm));
    set_metadata(surface.get(), layout);
    {
        const Context context(cairo_create(surface.get()));
        cairo_scale(context.get(), kPointsPerMm, kPointsPerMm);
        // Text is set as the font's designer measured it, not fitted to some device's pixels.
        const FontOptions options(cairo_font_options_create());
        cairo_font_options_set_hint_style(options.get(), CAIRO_HINT_STYLE_NONE);
        cairo_font_options_set_hint_metrics(options.get(), CAIRO_HINT_METRICS_OFF);
        cairo_set_font_options(context.get(), options.get());
        cairo_set_font_face(context.get(), font);
        const int count = static_cast<int>(layout.sheets.size());
        for (int i = 0; i < count; ++i) {
            const SheetDrawing drawing = draw_sheet(layout, profile, i);
            cairo_pdf_surface_set_size(surface.get(), drawing.width_mm * kPointsPerMm,
                                       drawing.height_mm * kPointsPerMm);
            PdfPage(context.get(), drawing, profile).draw();
            cairo_show_page(context.get());
        }
        if (const cairo_status_t status = cairo_status(context.get()); status != CAIRO_STATUS_SUCCESS) {
            return status;
        }
    }
    cairo_surface_finish(surface.get());
    return cairo_surface_status(surface.get());
}

}  // namespace

std::optional<std::vector<std::string>> write_pdf_with_font(const Layout& layout,
                                                            const OutputOptions& options,
                                                            const std::string& font_file,
                                                            Diagnostics& diagnostics) {
    for (const LayoutSheet& sheet : layout.sheets) {
        if (std::max(sheet.width_mm, sheet.height_mm) <= kLargestPageMm) continue;
        diagnostics
            .error("pdf-page-size", {},
                   fmt::format("a sheet of {:.1f} × {:.1f} mm is too large for a PDF page, which has at most "
                               "5080 mm a side",
                               sheet.width_mm, sheet.height_mm))
            .hint("choose a smaller sheet with --sheet, or write SVG");
        return std::nullopt;
    }
    const FontFace font = open_font(font_file);
    if (font == nullptr) {
        diagnostics
            .error("font-missing", {},
                   fmt::format("the font of the labels cannot be read from \"{}\"", font_file))
            .hint(
                "install DejaVu Sans (on Debian the package fonts-dejavu-core), or write SVG, which needs no "
                "font "
                "file");
        return std::nullopt;
    }
    std::string bytes;
    const cairo_status_t status = draw_document(layout, options.profile, font.get(), bytes);
    if (status != CAIRO_STATUS_SUCCESS) {
        diagnostics.error("pdf-failed", {},
                          fmt::format("the PDF could not be made: {}", cairo_status_to_string(status)));
        return std::nullopt;
    }
    return std::vector<std::string>{std::move(bytes)};
}

std::optional<std::vector<std::string>> write_pdf(const Layout& layout, const OutputOptions& options,
                                                  Diagnostics& diagnostics) {
    return write_pdf_with_font(layout, options, POPUP_FONT_FILE, diagnostics);
}

}  // namespace popup
