#include "output/raster.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "output/cairo_sheet.h"
#include "output/jpeg.h"
#include "output/png.h"
#include "output/sheet_drawing.h"

namespace popup {
namespace {

constexpr double kInch = 25.4;
constexpr double kLeastDpi = 0.01;
constexpr double kMostDpi = 10'000.0;
constexpr int kMostSide = 32767;
constexpr double kMostPixels = 300e6;

constexpr int kPageWidth = 800;
constexpr int kPageHeight = 650;
constexpr double kPageDpi = 72.0;
constexpr double kPageRoomMm = 5.0;  // at least, round pieces larger than the page
constexpr int kQuality = 92;

// Pixels that are painted at once: a sheet of A4 at 300 dpi is. Larger sheets are painted band by band, so
// that memory does not grow with them.
constexpr int kMostAtOnce = 10'000'000;

// A drawing on white, row by row from the top.
class Painting {
 public:
    // `scale`: pixels a mm.
    Painting(const SheetDrawing& drawing, int width, int height, double scale, cairo_font_face_t* font)
        : drawing_(drawing),
          width_(width),
          height_(height),
          scale_(scale),
          font_(font),
          rows_(std::clamp(kMostAtOnce / width, 1, height)),
          surface_(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, rows_)) {}

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    // False when Cairo gives no picture.
    bool copy_row(int y, unsigned char* rgb) {
        if (y >= end_ && !paint(y)) return false;
        const unsigned char* row =
            cairo_image_surface_get_data(surface_.get()) +
            static_cast<std::ptrdiff_t>(y - (end_ - rows_)) * cairo_image_surface_get_stride(surface_.get());
        for (int x = 0; x < width_; ++x) {
            std::uint32_t pixel = 0;
            std::copy_n(row + static_cast<std::ptrdiff_t>(x) * 4, 4,
                        reinterpret_cast<unsigned char*>(&pixel));
            for (const unsigned shift : {16U, 8U, 0U}) *rgb++ = static_cast<unsigned char>(pixel >> shift);
        }
        return true;
    }

 private:
    // The band that begins at a row.
    bool paint(int from) {
        const Context context(cairo_create(surface_.get()));
        cairo_set_source_rgb(context.get(), 1.0, 1.0, 1.0);
        cairo_paint(context.get());
        cairo_translate(context.get(), 0.0, -from);
        cairo_scale(context.get(), scale_, scale_);
        set_font(context.get(), font_);
        paint_sheet(context.get(), drawing_, pictures_);
        cairo_surface_flush(surface_.get());
        end_ = from + rows_;
        return cairo_status(context.get()) == CAIRO_STATUS_SUCCESS;
    }

    const SheetDrawing& drawing_;
    int width_;
    int height_;
    double scale_;
    cairo_font_face_t* font_;
    int rows_;  // of a band
    Surface surface_;
    PaintedPictures pictures_{PaintedPictures::For::pixels};
    int end_ = 0;  // of the band that is painted
};

std::optional<Pixels> all_of(Painting painting) {
    const auto row = static_cast<std::size_t>(painting.width()) * 3U;
    Pixels pixels{painting.width(), painting.height(), {}};
    pixels.rgb.resize(row * static_cast<std::size_t>(painting.height()));
    for (int y = 0; y < pixels.height; ++y) {
        if (!painting.copy_row(y, pixels.rgb.data() + row * static_cast<std::size_t>(y))) return std::nullopt;
    }
    return pixels;
}

void report_failure(std::string_view format, Diagnostics& diagnostics) {
    diagnostics
        .error("picture-failed", {},
               fmt::format("the {} could not be made: there is no memory for it", format))
        .hint("choose a smaller --dpi or --sheet");
}

// A layout of nothing but one piece, the middle of its page in the middle of the sheet.
Layout page_of(const Layout& layout, std::size_t design, std::size_t piece) {
    Layout page;
    page.designs = {{layout.designs[design].file, layout.designs[design].stem, {}}};
    page.designs.front().pattern.plate_names = layout.designs[design].pattern.plate_names;
    page.designs.front().pattern.pieces = {layout.designs[design].pattern.pieces[piece]};
    page.prefix_names = layout.prefix_names;
    const Box& box = page.designs.front().pattern.pieces.front().bounds;
    const Vec2 half{0.5 * kPageWidth / kPageDpi * kInch, 0.5 * kPageHeight / kPageDpi * kInch};
    const Vec2 reach{std::max(-box.min.x, box.max.x) + kPageRoomMm,
                     std::max(-box.min.y, box.max.y) + kPageRoomMm};
    const double more = std::max({1.0, reach.x / half.x, reach.y / half.y});
    LayoutSheet& sheet = page.sheets.emplace_back();
    sheet.width_mm = 2.0 * more * half.x;
    sheet.height_mm = 2.0 * more * half.y;
    page.margin_mm = layout.margin_mm;
    Placement placement;
    placement.offset = {more * half.x, more * half.y};
    page.placements = {placement};
    return page;
}

}  // namespace

std::optional<std::vector<SheetFile>> write_png(const Layout& layout, const OutputOptions& options,
                                                Diagnostics& diagnostics) {
    const double dpi = std::fmin(std::fmax(options.dpi, kLeastDpi), kMostDpi);
    const double scale = dpi / kInch;
    for (const LayoutSheet& sheet : layout.sheets) {
        const double width = std::ceil(sheet.width_mm * scale - 1e-6);
        const double height = std::ceil(sheet.height_mm * scale - 1e-6);
        if (std::max(width, height) <= kMostSide && width * height <= kMostPixels) continue;
        diagnostics
            .error("picture-too-large", {},
                   fmt::format(
                       "a sheet of {:.1f} × {:.1f} mm has {:.0f} × {:.0f} pixels at {} dpi; a picture "
                       "has at most {} on a side and {:.0f} million in all",
                       sheet.width_mm, sheet.height_mm, width, height, dpi, kMostSide, kMostPixels / 1e6))
            .hint("choose a smaller --dpi");
        return std::nullopt;
    }
    const FontFace font = open_font(POPUP_FONT_FILE);
    if (font == nullptr) {
        report_missing_font(POPUP_FONT_FILE, diagnostics);
        return std::nullopt;
    }
    const auto write = [&](const SheetDrawing& drawing, const SheetView&) -> std::optional<std::string> {
        Painting painting(drawing, static_cast<int>(std::ceil(drawing.width_mm * scale - 1e-6)),
                          static_cast<int>(std::ceil(drawing.height_mm * scale - 1e-6)), scale, font.get());
        const auto row_of = [&](int y, unsigned char* row) { return painting.copy_row(y, row); };
        std::string bytes;
        if (to_png(painting.width(), painting.height(), row_of, dpi, bytes)) return bytes;
        report_failure("PNG", diagnostics);
        return std::nullopt;
    };
    return file_per_view(layout, options, diagnostics, write);
}

std::optional<std::vector<SheetFile>> write_jpg(const Layout& layout, const OutputOptions& /*options*/,
                                                Diagnostics& diagnostics) {
    const FontFace font = open_font(POPUP_FONT_FILE);
    if (font == nullptr) {
        report_missing_font(POPUP_FONT_FILE, diagnostics);
        return std::nullopt;
    }
    // A page of its own has no marks, no bar and no back, and is for eyes, not for a machine.
    const OutputOptions plain;
    std::vector<SheetFile> files;
    for (std::size_t d = 0; d < layout.designs.size(); ++d) {
        for (std::size_t p = 0; p < layout.designs[d].pattern.pieces.size(); ++p) {
            const Layout page = page_of(layout, d, p);
            const SheetDrawing drawing = draw_sheet(page, plain, SheetView{});
            const auto pixels =
                all_of({drawing, kPageWidth, kPageHeight, kPageWidth / drawing.width_mm, font.get()});
            SheetFile& file = files.emplace_back();
            if (files.size() > 1) file.suffix = fmt::format("-{}", files.size());
            if (pixels && to_jpeg(*pixels, kQuality, kPageDpi, file.bytes)) continue;
            report_failure("JPEG", diagnostics);
            return std::nullopt;
        }
    }
    return files;
}

}  // namespace popup
