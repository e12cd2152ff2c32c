#include "output/book/book_pages.h"

#include <cairo-pdf.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>

#include "base/diagnostics/render_diagnostics.h"
#include "output/page_texts.h"
#include "output/pdf_pages.h"

namespace popup::book {
namespace {

constexpr double kPageSideMm = 17.0;
constexpr double kPageHeadMm = 16.0;
constexpr double kPageFootMm = 17.0;
constexpr double kLeadingCaps = 2.0;  // from line to line, in heights of capitals
constexpr double kMarkCapMm = 1.9;

// A picture as Cairo has it, with the file that goes into the document.
Surface surface_of(const Pixels& pixels, const std::string& jpeg) {
    Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, pixels.width, pixels.height));
    if (cairo_surface_status(surface.get()) != CAIRO_STATUS_SUCCESS) return nullptr;
    auto kept = std::make_unique<std::string>(jpeg);
    const auto give_back = [](void* data) { delete static_cast<std::string*>(data); };
    if (cairo_surface_set_mime_data(surface.get(), CAIRO_MIME_TYPE_JPEG,
                                    reinterpret_cast<const unsigned char*>(kept->data()), kept->size(),
                                    give_back, kept.get()) != CAIRO_STATUS_SUCCESS)
        return nullptr;
    static_cast<void>(kept.release());
    return surface;
}

}  // namespace

BookPages::BookPages(cairo_surface_t* surface, cairo_t* context, cairo_font_face_t* plain,
                     cairo_font_face_t* bold, bool letter, const std::string& footer)
    : surface_(surface),
      cairo_(context),
      plain_(plain),
      bold_(bold),
      footer_(visible(footer)),
      left_(kPageSideMm),
      top_(kPageHeadMm),
      y_(kPageHeadMm),
      page_width_(letter ? 215.9 : 210.0),
      page_height_(letter ? 279.4 : 297.0) {
    right_ = page_width_ - kPageSideMm;
    low_ = page_height_ - kPageFootMm;
    cairo_pdf_surface_set_size(surface, page_width_ * kPointsPerMm, page_height_ * kPointsPerMm);
}

void BookPages::set_bold(bool bold) {
    if (bold == is_bold_) return;
    is_bold_ = bold;
    set_font(cairo_, bold ? bold_ : plain_);
}

void BookPages::next_page() {
    if (!used_ && y_ <= top_) return;
    finish();
    ++page_;
    y_ = top_;
    used_ = false;
}

void BookPages::finish() {
    set_bold(false);
    grey(cairo_, 0.45);
    const double base = page_height_ - 9.0;
    const std::string number = std::to_string(page_);
    write_from(cairo_, footer_, {left_, base}, kSmallCapMm);
    write_from(cairo_, number, {right_ - text_length(cairo_, number, kSmallCapMm), base}, kSmallCapMm);
    cairo_show_page(cairo_);
}

int BookPages::outline(const std::string& title, int parent) {
    const std::string where = fmt::format("page={} pos=[{:.1f} {:.1f}]", page_, left_ * kPointsPerMm,
                                          std::max(0.0, y_ - 4.0) * kPointsPerMm);
    return cairo_pdf_surface_add_outline(surface_, parent, visible(title).c_str(), where.c_str(),
                                         static_cast<cairo_pdf_outline_flags_t>(0));
}

std::vector<std::string> BookPages::wrap(std::string_view text, double cap, double wide, bool bold) {
    set_bold(bold);
    return wrapped(cairo_, visible(text), cap, wide);
}

double BookPages::height(std::size_t lines, double cap) {
    return static_cast<double>(lines) * kLeadingCaps * cap;
}

double BookPages::length(std::string_view text, double cap, bool bold) {
    set_bold(bold);
    return text_length(cairo_, visible(text), cap);
}

void BookPages::line_at(std::string_view text, double cap, double x, double y, bool bold, double white) {
    set_bold(bold);
    grey(cairo_, white);
    write_from(cairo_, visible(text), {x, y}, cap);
    used_ = true;
}

void BookPages::text(std::string_view text, double cap, double x, double wide, bool bold, double white) {
    for (const std::string& line : wrap(text, cap, wide, bold)) {
        need(kLeadingCaps * cap);
        line_at(line, cap, x, y_ + cap, bold, white);
        y_ += kLeadingCaps * cap;
    }
}

void BookPages::rule(double y, double white) {
    grey(cairo_, white);
    cairo_set_dash(cairo_, nullptr, 0, 0.0);
    cairo_set_line_width(cairo_, 0.25);
    cairo_move_to(cairo_, left_, y);
    cairo_line_to(cairo_, right_, y);
    cairo_stroke(cairo_);
    used_ = true;
}

double BookPages::figure_scale(const Figure& figure, double wide, double high) {
    return std::min({1.0, wide / figure.width_mm, high / figure.height_mm});
}

double BookPages::figure(const Figure& figure, double x, double y, double wide, double high) {
    const double scale = figure_scale(figure, wide, high);
    const double from = x + 0.5 * (wide - scale * figure.width_mm);
    const auto at = [&](Vec2 p) { return Vec2{from + scale * p.x, y + scale * p.y}; };
    for (const Figure::Shape& shape : figure.shapes) {
        cairo_new_path(cairo_);
        for (const std::vector<Vec2>& line : shape.lines) {
            cairo_new_sub_path(cairo_);
            for (const Vec2 p : line) cairo_line_to(cairo_, at(p).x, at(p).y);
            if (shape.closed) cairo_close_path(cairo_);
        }
        if (shape.fill) {
            cairo_set_source_rgb(cairo_, shape.fill->r / 255.0, shape.fill->g / 255.0, shape.fill->b / 255.0);
            cairo_set_fill_rule(cairo_, CAIRO_FILL_RULE_EVEN_ODD);
            cairo_fill_preserve(cairo_);
        }
        if (shape.ink) {
            const InkLook& look = look_of(*shape.ink);
            cairo_set_source_rgb(cairo_, look.color.r / 255.0, look.color.g / 255.0, look.color.b / 255.0);
            cairo_set_line_width(cairo_, look.width_mm);
            cairo_set_line_join(cairo_, CAIRO_LINE_JOIN_ROUND);
            const bool dashed = look.dashes_mm[0] > 0.0;
            cairo_set_dash(cairo_, look.dashes_mm.data(), dashed ? 4 : 0, 0.0);
            cairo_stroke_preserve(cairo_);
        }
        cairo_new_path(cairo_);
    }
    cairo_set_dash(cairo_, nullptr, 0, 0.0);
    for (const Figure::Label& label : figure.labels) {
        const bool tight =
            !label.brief.empty() && length(label.text, kMarkCapMm, true) > scale * label.room_mm;
        badge(tight ? label.brief : label.text, at(label.at), kMarkCapMm);
    }
    used_ = true;
    return scale * figure.height_mm;
}

// On a white plate, because anything may be below.
void BookPages::badge(std::string_view name, Vec2 at, double cap) {
    const std::string text = visible(name);
    set_bold(true);
    const double half = 0.5 * text_length(cairo_, text, cap) + 0.45 * cap;
    cairo_set_source_rgba(cairo_, 1.0, 1.0, 1.0, 0.86);
    cairo_rectangle(cairo_, at.x - half, at.y - 0.95 * cap, 2.0 * half, 1.9 * cap);
    cairo_fill(cairo_);
    grey(cairo_, 0.05);
    write(cairo_, text, at, cap);
}

void BookPages::picture(const Picture& picture, const std::string& jpeg, double x, double y, double wide) {
    const Surface surface = surface_of(picture.pixels, jpeg);
    if (surface == nullptr) return;
    const double scale = wide / picture.pixels.width;
    const double high = scale * picture.pixels.height;
    cairo_save(cairo_);
    cairo_translate(cairo_, x, y);
    cairo_scale(cairo_, scale, scale);
    cairo_set_source_surface(cairo_, surface.get(), 0.0, 0.0);
    cairo_paint(cairo_);
    cairo_restore(cairo_);
    for (const PictureMark& mark : picture.marks)
        badge(mark.text, {x + mark.x * wide, y + mark.y * high}, kMarkCapMm);
    used_ = true;
}

}  // namespace popup::book
