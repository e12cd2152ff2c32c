// A page that is filled from its top: texts, tables, drawings and pictures of a book, with Cairo. Texts may
// be any bytes: what is no character is written as its number.
#pragma once

#include <cairo.h>

#include <string>
#include <string_view>
#include <vector>

#include "output/book/figure.h"
#include "output/book/scene.h"
#include "output/cairo_sheet.h"

namespace popup::book {

// Heights of capitals.
inline constexpr double kTitleCapMm = 8.0;
inline constexpr double kChapterCapMm = 4.4;
inline constexpr double kStepCapMm = 3.1;
inline constexpr double kBodyCapMm = 2.35;
inline constexpr double kSmallCapMm = 1.9;

class BookPages {
 public:
    BookPages(cairo_surface_t* surface, cairo_t* context, cairo_font_face_t* plain, cairo_font_face_t* bold,
              bool letter, const std::string& footer);

    [[nodiscard]] double width() const { return right_ - left_; }
    // What is left of the page, and all that there is.
    [[nodiscard]] double room() const { return low_ - y_; }
    [[nodiscard]] double whole() const { return low_ - top_; }
    [[nodiscard]] double y() const { return y_; }
    [[nodiscard]] double left() const { return left_; }
    void skip(double mm) { y_ += mm; }
    void go_to(double y) { y_ = y; }
    // Ends the page, if anything is on it.
    void next_page();
    // Ends it if there is less room than that.
    void need(double mm) {
        if (room() < mm) next_page();
    }
    // Ends the last page.
    void finish();
    // An entry of the document's outline that leads here; returns its number, to be a parent of others.
    int outline(const std::string& title, int parent);

    // Lines of at most `wide` mm.
    std::vector<std::string> wrap(std::string_view text, double cap, double wide, bool bold = false);
    // Their height.
    [[nodiscard]] static double height(std::size_t lines, double cap);
    // A paragraph from `x` on, page by page if need be.
    void text(std::string_view text, double cap, double x, double wide, bool bold = false, double grey = 0.1);
    // One line at a place, whatever is there.
    void line_at(std::string_view text, double cap, double x, double y, bool bold = false, double grey = 0.1);
    double length(std::string_view text, double cap, bool bold = false);

    void rule(double y, double grey = 0.75);
    // A drawing in a box, as large as it can be but not larger than in truth; returns its height.
    double figure(const Figure& figure, double x, double y, double wide, double high);
    [[nodiscard]] static double figure_scale(const Figure& figure, double wide, double high);
    // A picture, whose JPEG file is given, with its numbers.
    void picture(const Picture& picture, const std::string& jpeg, double x, double y, double wide);

 private:
    void set_bold(bool bold);
    void badge(std::string_view name, Vec2 at, double cap);

    cairo_surface_t* surface_;
    cairo_t* cairo_;
    cairo_font_face_t* plain_;
    cairo_font_face_t* bold_;
    bool is_bold_ = false;
    std::string footer_;
    double left_, right_, top_, low_, y_;
    double page_width_, page_height_;
    int page_ = 1;
    bool used_ = false;
};

}  // namespace popup::book
