#include "output/tile_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/text/numbers.h"
#include "output/cairo_sheet.h"
#include "output/page_texts.h"

namespace popup {
namespace {

constexpr double kTitleMm = 3.2;  // heights of capitals
constexpr double kPlanTextMm = 2.0;
constexpr double kLeading = 2.1;  // from line to line, in heights of capitals
constexpr double kBarTickMm = 1.2;
constexpr double kBarLineMm = 0.25;
constexpr double kSeamMm = 0.3;
constexpr double kNameMm = 3.2;      // of tiles; smaller where there is no room
constexpr double kPageNumber = 0.6;  // their pages' numbers, as a part of that
constexpr double kPlanGrey = 0.15;

// The longest bar of a round length that fits into this.
double bar_length(double room_mm) {
    for (const double mm : {100.0, 50.0}) {
        if (mm <= room_mm) return mm;
    }
    return 20.0;
}

// From (x, y) to the right, with ticks at its ends.
void bar(cairo_t* context, double x, double y, double length) {
    grey(context, 0.0);
    for (const double end : {x, x + length}) {
        cairo_move_to(context, end, y - kBarTickMm);
        cairo_line_to(context, end, y + kBarTickMm);
    }
    cairo_move_to(context, x, y);
    cairo_line_to(context, x + length, y);
    cairo_set_dash(context, nullptr, 0, 0.0);
    cairo_set_line_cap(context, CAIRO_LINE_CAP_BUTT);
    cairo_set_line_width(context, kBarLineMm);
    cairo_stroke(context);
}

std::string size_text(double width, double height) {
    return fmt::format("{} × {} mm", number_text(width, 1), number_text(height, 1));
}

void seam_color(cairo_t* context) { cairo_set_source_rgb(context, 0.1, 0.3, 0.75); }

class Plan {
 public:
    Plan(cairo_t* context, const TiledSheet& sheet, const TileOptions& paper, std::size_t first_page,
         Vec2 page)
        : cairo_(context),
          sheet_(sheet),
          grid_(sheet.grid),
          first_page_(first_page),
          left_(paper.margin_mm),
          y_(paper.margin_mm),
          right_(page.x - paper.margin_mm),
          low_(page.y - paper.margin_mm) {}

    void draw(PaintedPictures& pictures) {
        // On small paper texts are smaller, so that most of it remains for the picture.
        text_mm_ = std::clamp((low_ - y_) / 85.0, 0.8, kPlanTextMm);
        grey(cairo_, kPlanGrey);
        const double title = kTitleMm * text_mm_ / kPlanTextMm;
        paragraph(sheet_.drawing.title + ": plan of the pages", title);
        y_ += 0.5 * text_mm_;
        for (const std::string& text : instructions()) paragraph(text, text_mm_);
        measure();
        picture(pictures);
    }

 private:
    void paragraph(const std::string& text, double cap) {
        for (const std::string& one : wrapped(cairo_, text, cap, right_ - left_)) {
            y_ += cap;
            write_from(cairo_, one, {left_, y_}, cap);
            y_ += (kLeading - 1.0) * cap;
        }
    }

    [[nodiscard]] std::vector<std::string> instructions() const {
        const std::size_t last = first_page_ + sheet_.pages - 1;
        std::vector<std::string> texts;
        texts.push_back(fmt::format("The sheet, {}, is printed on {} of {}: {}.",
                                    size_text(sheet_.drawing.width_mm, sheet_.drawing.height_mm),
                                    sheet_.pages == 1 ? "1 page" : fmt::format("{} pages", sheet_.pages),
                                    size_text(grid_.page_width_mm, grid_.page_height_mm),
                                    sheet_.pages == 1 ? fmt::format("page {}", last)
                                                      : fmt::format("pages {} to {}", first_page_, last)));
        const bool both = grid_.columns > 1 && grid_.rows > 1;
        texts.push_back(
            fmt::format("Print at 100 %, without fitting to the page. Cut along the dashed {}, lay the page "
                        "over the grey "
                        "strip of its neighbour, and glue. {}After that cut and fold the pieces.",
                        both                ? "lines at the right and lower edges of pages"
                        : grid_.columns > 1 ? "line at the right edge of a page"
                                            : "line at the lower edge of a page",
                        both ? "First glue the pages of each row, then the rows. " : ""));
        if (static_cast<double>(sheet_.pages) < grid_.tiles())
            texts.emplace_back("Nothing is drawn where the plan is hatched: those pages are left out.");
        return texts;
    }

    // At the foot of the page.
    void measure() {
        const double length = bar_length(right_ - left_);
        const double room = right_ - left_ - length - 3.0;
        const std::string what = fmt::format(
            "{} mm: measure this bar. If it has another length, the printer has changed the size.",
            number_text(length, 0));
        // Beside the bar, or above it.
        const bool beside = room > 60.0;
        const std::vector<std::string> lines =
            wrapped(cairo_, what, text_mm_, beside ? room : right_ - left_);
        const double step = kLeading * text_mm_;
        const double height = static_cast<double>(lines.size()) * step;
        const double x = beside ? left_ + length + 3.0 : left_;
        low_ -= kBarTickMm;
        double y = beside ? low_ - 0.5 * (height - step) + 0.5 * text_mm_ : low_ - height;
        if (beside) y = std::min(y, low_ + kBarTickMm - (height - step));
        bar(cairo_, left_ + 0.5 * kBarLineMm, low_, length);
        grey(cairo_, kPlanGrey);
        const double first = y - text_mm_;
        for (const std::string& one : lines) {
            write_from(cairo_, one, {x, y}, text_mm_);
            y += step;
        }
        low_ = std::min(first, low_ - kBarTickMm) - 2.0;
    }

    // The sheet, as large as there is room, but not larger than it is.
    void picture(PaintedPictures& pictures) {
        const SheetDrawing& drawing = sheet_.drawing;
        y_ += text_mm_;
        const double scale =
            std::min({1.0, (right_ - left_) / drawing.width_mm, (low_ - y_) / drawing.height_mm});
        if (scale <= 0.0) return;
        cairo_save(cairo_);
        cairo_translate(cairo_, 0.5 * (left_ + right_ - scale * drawing.width_mm), y_);
        cairo_scale(cairo_, scale, scale);
        cairo_rectangle(cairo_, 0.0, 0.0, drawing.width_mm, drawing.height_mm);
        grey(cairo_, 0.6);
        cairo_set_dash(cairo_, nullptr, 0, 0.0);
        cairo_set_line_width(cairo_, 0.2 / scale);
        cairo_stroke(cairo_);
        each_tile([&](int row, int column) {
            if (!sheet_.printed(row, column)) hatch(row, column, scale);
        });
        paint_sheet(cairo_, drawing, pictures);
        seam_color(cairo_);
        cairo_set_dash(cairo_, nullptr, 0, 0.0);
        cairo_set_line_width(cairo_, kSeamMm / scale);
        each_tile([&](int row, int column) {
            if (sheet_.printed(row, column)) outline(grid_.seen(row, column));
        });
        cairo_stroke(cairo_);
        each_tile([&](int row, int column) {
            if (sheet_.printed(row, column)) name(row, column, scale);
        });
        cairo_restore(cairo_);
    }

    template <typename Use>
    void each_tile(Use use) {
        for (int row = 0; row < grid_.rows; ++row) {
            for (int column = 0; column < grid_.columns; ++column) use(row, column);
        }
    }

    void outline(const Box& box) {
        cairo_rectangle(cairo_, box.min.x, sheet_.drawing.height_mm - box.max.y, box.width(), box.height());
    }

    // On a white plate, because anything may be drawn below.
    void name(int row, int column, double scale) {
        const Box seen = grid_.seen(row, column);
        const double side = std::min(seen.width(), seen.height());
        const std::string name = tile_name(row, column);
        const std::string page = fmt::format("page {}", first_page_ + pages_before_++);
        double cap = std::min(0.16 * side, kNameMm / scale);
        const auto width = [&] {
            return std::max(text_length(cairo_, name, cap), text_length(cairo_, page, kPageNumber * cap)) +
                   cap;
        };
        cap *= std::min(1.0, 0.8 * side / width());
        const double height = (2.5 + kPageNumber) * cap;
        const Vec2 at{seen.centre().x, sheet_.drawing.height_mm - seen.centre().y};
        cairo_rectangle(cairo_, at.x - 0.5 * width(), at.y - 0.5 * height, width(), height);
        grey(cairo_, 1.0);
        cairo_fill_preserve(cairo_);
        seam_color(cairo_);
        cairo_set_line_width(cairo_, 0.5 * kSeamMm / scale);
        cairo_stroke(cairo_);
        write(cairo_, name, {at.x, at.y - 0.5 * height + 1.1 * cap}, cap);
        write(cairo_, page, {at.x, at.y + 0.5 * height - (0.6 + 0.5 * kPageNumber) * cap}, kPageNumber * cap);
    }

    void hatch(int row, int column, double scale) {
        const Box seen = grid_.seen(row, column);
        cairo_save(cairo_);
        outline(seen);
        cairo_clip(cairo_);
        const double step = 2.5 / scale;
        const double top = sheet_.drawing.height_mm - seen.max.y;
        const int lines = static_cast<int>((seen.width() + seen.height()) / step) + 1;
        for (int i = 0; i < lines; ++i) {
            const double x = seen.min.x - seen.height() + i * step;
            cairo_move_to(cairo_, x, top + seen.height());
            cairo_line_to(cairo_, x + seen.height(), top);
        }
        grey(cairo_, 0.75);
        cairo_set_line_width(cairo_, 0.15 / scale);
        cairo_stroke(cairo_);
        cairo_restore(cairo_);
    }

    cairo_t* cairo_;
    const TiledSheet& sheet_;
    const TileGrid& grid_;
    std::size_t first_page_;
    double left_, y_, right_, low_;  // what of the page is still free
    double text_mm_ = kPlanTextMm;
    std::size_t pages_before_ = 0;  // those of tiles that have their name already
};

}  // namespace

Vec2 plan_size(const TiledSheet& sheet, const TileOptions& paper) {
    const auto [narrow, wide] = std::minmax({paper.width_mm, paper.height_mm});
    return sheet.drawing.width_mm > sheet.drawing.height_mm ? Vec2{wide, narrow} : Vec2{narrow, wide};
}

void draw_plan(cairo_t* context, const TiledSheet& sheet, const TileOptions& paper, std::size_t first_page,
               PaintedPictures& pictures) {
    Plan(context, sheet, paper, first_page, plan_size(sheet, paper)).draw(pictures);
}

void draw_whole_label(cairo_t* context, const TiledSheet& sheet, const TileOptions& paper, std::size_t page,
                      std::size_t pages) {
    const TileGrid& grid = sheet.grid;
    const double middle = 0.5 * grid.page_width_mm;
    const double room = grid.page_width_mm - 2.0 * paper.margin_mm;
    // In the margin's inner part, wherever the drawing ends.
    const double in_margin = paper.margin_mm - 0.5 * kTileBandMm;
    grey(context, kPlanGrey);
    write_fitting(context, fmt::format("{} · page {} of {}", sheet.drawing.title, page, pages),
                  {middle, grid.page_height_mm - in_margin}, 1.7, room);
    const double length = bar_length(room - 30.0);
    const std::string figure = fmt::format("{} mm", number_text(length, 0));
    bar(context, middle - 0.5 * length, in_margin, length);
    grey(context, kPlanGrey);
    const double figure_room = std::max(0.5 * (room - length) - 1.0, 3.0);
    const double figure_length = std::min(text_length(context, figure, 1.7), figure_room);
    write_fitting(context, figure, {middle + 0.5 * length + 1.5 + 0.5 * figure_length, in_margin}, 1.7,
                  figure_room);
}

}  // namespace popup
