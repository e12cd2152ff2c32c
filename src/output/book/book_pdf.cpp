#include "output/book/book_pdf.h"

#include <cairo-pdf.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "base/diagnostics/render_diagnostics.h"
#include "base/text/font_file.h"
#include "output/book/book.h"
#include "output/book/book_pages.h"
#include "output/book/pictures.h"
#include "output/page_texts.h"
#include "output/pdf_document.h"

namespace popup {
namespace book {
namespace {

constexpr double kColumnGapMm = 5.0;   // between pictures side by side
constexpr double kFigureShare = 0.34;  // of the page's width, for a drawing beside text
constexpr double kFigureHighMm = 46.0;
constexpr double kSheetHighMm = 104.0;
constexpr double kLargeHighMm = 110.0;
constexpr double kBulletMm = 5.0;
constexpr double kBulletGapMm = 0.8;  // bullets
constexpr double kNeedMm = 24.0;      // before what is needed
constexpr double kChapterMm = 17.0;   // a chapter's title and what is around it
constexpr double kLeastCover = 0.6;   // of its width; smaller it would show little

class Writer {
 public:
    Writer(BookPages& paper, const Book& book, Pictures& pictures)
        : paper_(paper), book_(book), pictures_(pictures) {}

    bool write() {
        if (!cover()) return false;
        needs();
        sheets();
        return std::all_of(book_.cards.begin(), book_.cards.end(),
                           [this](const CardPart& part) { return card(part); });
    }

 private:
    [[nodiscard]] double picture_width() const { return 0.5 * (paper_.width() - kColumnGapMm); }
    static double height_of(double wide, PictureSize size) { return wide * size.height / size.width; }

    // The next picture, and the one after it, side by side.
    bool show(std::span<const Scene> scenes, std::span<const std::string> captions, double wide,
              PictureSize size) {
        if (scenes.empty()) return true;
        const std::optional<std::vector<ShownPicture>> shown = pictures_.draw(scenes, size);
        if (!shown) return false;
        const double high = height_of(wide, size);
        double x = paper_.left();
        if (shown->size() == 1) x += 0.5 * (paper_.width() - wide);
        for (std::size_t i = 0; i < shown->size(); ++i) {
            paper_.picture((*shown)[i].picture, (*shown)[i].jpeg, x, paper_.y(), wide);
            if (i < captions.size())
                paper_.line_at(captions[i], kSmallCapMm, x, paper_.y() + high + 1.7 * kSmallCapMm, false,
                               0.35);
            x += wide + kColumnGapMm;
        }
        paper_.skip(high + (captions.empty() ? 0.0 : 2.4 * kSmallCapMm));
        return true;
    }

    void chapter(const std::string& title, double room, int parent) {
        paper_.need(std::min(room + 16.0, paper_.whole()));
        if (paper_.room() < paper_.whole() - 1.0) paper_.skip(6.0);
        chapter_ = paper_.outline(title, parent);
        paper_.line_at(title, kChapterCapMm, paper_.left(), paper_.y() + kChapterCapMm, true);
        paper_.skip(1.7 * kChapterCapMm);
        paper_.rule(paper_.y());
        paper_.skip(3.5);
    }

    [[nodiscard]] double height_of_bullet(const std::string& text) {
        return lines_height(text, paper_.width() - kBulletMm) + kBulletGapMm;
    }
    [[nodiscard]] double height_of_bullets(const std::vector<std::string>& texts) {
        double high = 0.0;
        for (const std::string& text : texts) high += height_of_bullet(text);
        return high;
    }

    // The last one is never alone on a page.
    void bullets(const std::vector<std::string>& texts, bool numbered) {
        for (std::size_t i = 0; i < texts.size(); ++i) {
            double high = height_of_bullet(texts[i]) - kBulletGapMm;
            if (i + 2 == texts.size()) high += height_of_bullet(texts[i + 1]);
            paper_.need(std::min(high, paper_.whole()));
            paper_.line_at(numbered ? fmt::format("{}.", i + 1) : "•", kBodyCapMm, paper_.left(),
                           paper_.y() + kBodyCapMm);
            paper_.text(texts[i], kBodyCapMm, paper_.left() + kBulletMm, paper_.width() - kBulletMm);
            paper_.skip(kBulletGapMm);
        }
    }

    // Of what stands below the picture on the first page.
    [[nodiscard]] double height_below_cover() {
        double high = kColumnGapMm + kChapterMm;
        for (const auto& [name, value] : book_.needs)
            high += lines_height(value, paper_.width() - kNeedMm) + kBulletGapMm;
        if (!book_.first.empty()) high += kChapterMm + height_of_bullets(book_.first);
        return high;
    }
    // One picture is as wide as the page, or a little less where all of the first page fits on it then.
    [[nodiscard]] double cover_width() {
        if (book_.cover.size() != 1) return picture_width();
        const double whole = paper_.width();
        const double room = paper_.room() - height_below_cover();
        const double share = room / height_of(whole, kCoverPicture);
        return share < kLeastCover ? whole : whole * std::min(1.0, share);
    }

    bool cover() {
        paper_.skip(10.0);
        for (const std::string& line : paper_.wrap(book_.title, kTitleCapMm, paper_.width(), true)) {
            paper_.line_at(line, kTitleCapMm, paper_.left(), paper_.y() + kTitleCapMm, true);
            paper_.skip(1.7 * kTitleCapMm);
        }
        paper_.line_at(book_.subtitle, kChapterCapMm, paper_.left(), paper_.y() + kChapterCapMm, false, 0.35);
        paper_.skip(2.6 * kChapterCapMm);
        chapter_ = paper_.outline(book_.title, CAIRO_PDF_OUTLINE_ROOT);
        const PictureSize size = kCoverPicture;
        const std::size_t count = book_.cover.size();
        const double wide = cover_width();
        for (std::size_t i = 0; i < count; i += 2) {
            const std::size_t here = count == 1 ? 1 : std::min<std::size_t>(2, count - i);
            paper_.need(height_of(wide, size));
            const double y = paper_.y();
            for (std::size_t k = 0; k < here; ++k) {
                const auto shown = pictures_.draw(std::span(book_.cover).subspan(i + k, 1), size);
                if (!shown) return false;
                const double from = count == 1 ? 0.5 * (paper_.width() - wide) : 0.0;
                const double x = paper_.left() + from + static_cast<double>(k) * (wide + kColumnGapMm);
                paper_.picture(shown->front().picture, shown->front().jpeg, x, y, wide);
            }
            paper_.skip(height_of(wide, size) + kColumnGapMm);
        }
        return true;
    }

    void needs() {
        chapter(book_.needs_title, 40.0, CAIRO_PDF_OUTLINE_ROOT);
        for (const auto& [name, value] : book_.needs) {
            const std::size_t lines = paper_.wrap(value, kBodyCapMm, paper_.width() - kNeedMm).size();
            paper_.need(BookPages::height(lines, kBodyCapMm));
            paper_.line_at(name, kBodyCapMm, paper_.left(), paper_.y() + kBodyCapMm, true);
            paper_.text(value, kBodyCapMm, paper_.left() + kNeedMm, paper_.width() - kNeedMm);
            paper_.skip(kBulletGapMm);
        }
        if (!book_.first.empty())
            chapter("Before you begin", height_of_bullets(book_.first), CAIRO_PDF_OUTLINE_ROOT);
        bullets(book_.first, false);
    }

    void sheets() {
        if (book_.sheets.empty()) return;
        chapter("The sheets", 60.0, CAIRO_PDF_OUTLINE_ROOT);
        for (const SheetPart& sheet : book_.sheets) {
            const double scale = BookPages::figure_scale(sheet.figure, paper_.width(), kSheetHighMm);
            const double key = sheet.key.empty() ? 0.0 : 1.0 + lines_height(sheet.key, paper_.width());
            paper_.need(scale * sheet.figure.height_mm + key + 8.0);
            paper_.text(sheet.title, kBodyCapMm, paper_.left(), paper_.width());
            const double high =
                paper_.figure(sheet.figure, paper_.left(), paper_.y(), paper_.width(), kSheetHighMm);
            paper_.skip(high + (sheet.key.empty() ? 5.0 : 1.0));
            if (sheet.key.empty()) continue;
            paper_.text(sheet.key, kBodyCapMm, paper_.left(), paper_.width(), false, 0.3);
            paper_.skip(4.0);
        }
    }

    void row(const std::array<std::string, 5>& cells, bool head) {
        const double wide = paper_.width();
        const std::array<double, 5> columns{0.0, 0.08, 0.40, 0.50, 0.74};
        std::array<std::vector<std::string>, 5> lines;
        std::size_t most = 1;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const double end = i + 1 < columns.size() ? columns.at(i + 1) : 1.0;
            lines.at(i) = paper_.wrap(cells.at(i), kSmallCapMm, (end - columns.at(i)) * wide - 2.0, head);
            most = std::max(most, lines.at(i).size());
        }
        const double high = BookPages::height(most, kSmallCapMm);
        paper_.need(high + 1.0);
        for (std::size_t i = 0; i < cells.size(); ++i) {
            double y = paper_.y() + kSmallCapMm;
            for (const std::string& line : lines.at(i)) {
                paper_.line_at(line, kSmallCapMm, paper_.left() + columns.at(i) * wide, y, head);
                y += BookPages::height(1, kSmallCapMm);
            }
        }
        paper_.skip(high);
        paper_.rule(paper_.y(), head ? 0.4 : 0.88);
        paper_.skip(1.2);
    }

    void parts(const CardPart& part) {
        if (part.parts.empty()) return;
        chapter("Pieces", 30.0, CAIRO_PDF_OUTLINE_ROOT);
        row({"No.", "Piece", "Sheet", "Folds", "Tabs"}, true);
        for (const PartRow& one : part.parts)
            row({one.number, one.name, one.sheets, one.folds, one.tabs}, false);
    }

    bool card(const CardPart& part) {
        if (book_.cards.size() > 1) {
            paper_.next_page();
            paper_.line_at(part.title, kTitleCapMm, paper_.left(), paper_.y() + kTitleCapMm, true);
            paper_.skip(1.8 * kTitleCapMm);
        }
        parts(part);
        for (const Chapter& one : part.chapters) {
            if (one.steps.empty()) continue;
            chapter(one.title, height_of_step(one.steps.front()) + (one.intro.empty() ? 0.0 : 8.0),
                    CAIRO_PDF_OUTLINE_ROOT);
            if (!one.intro.empty()) {
                paper_.text(one.intro, kBodyCapMm, paper_.left(), paper_.width(), false, 0.25);
                paper_.skip(2.0);
            }
            for (const Step& made : one.steps) {
                if (!step(made)) return false;
            }
        }
        return closing(part);
    }

    // A step's texts stand beside its drawing, if it has one only; else drawings stand in rows above them.
    [[nodiscard]] static bool has_beside(const Step& step) {
        return step.figures.size() == 1 && !step.large_figures;
    }
    [[nodiscard]] static bool is_one_large(const Step& step) {
        return step.figures.size() == 1 && step.large_figures;
    }
    [[nodiscard]] double text_width(const Step& step) const {
        return paper_.width() * (has_beside(step) ? 1.0 - kFigureShare : 1.0) -
               (has_beside(step) ? kColumnGapMm : 0.0);
    }
    [[nodiscard]] double texts_height(const Step& step) {
        double high = step.lies.empty() ? 0.0 : lines_height(step.lies, text_width(step)) + 1.0;
        for (const std::string& text : step.actions)
            high += lines_height(text, text_width(step) - kBulletMm) + 0.8;
        for (const std::string& text : step.notes)
            high += lines_height(text, text_width(step) - kBulletMm) + 0.8;
        return high;
    }
    [[nodiscard]] double lines_height(const std::string& text, double wide) {
        return BookPages::height(paper_.wrap(text, kBodyCapMm, wide).size(), kBodyCapMm);
    }
    [[nodiscard]] double figure_width() const { return kFigureShare * paper_.width(); }
    [[nodiscard]] double scenes_height(const Step& step) const {
        return step.scenes.empty() ? 0.0 : height_of(picture_width(), kStepPicture) + 2.4 * kSmallCapMm + 1.0;
    }
    [[nodiscard]] double rows_height(const Step& step) {
        if (has_beside(step) || step.figures.empty()) return 0.0;
        const double key = step.key.empty() ? 0.0 : 1.0 + lines_height(step.key, paper_.width());
        if (is_one_large(step)) {
            const Figure& figure = step.figures.front();
            return BookPages::figure_scale(figure, paper_.width(), kLargeHighMm) * figure.height_mm + key +
                   3.0;
        }
        double high = key;
        for (std::size_t i = 0; i < step.figures.size(); i += 3) high += row_height(step, i) + 3.0;
        return high;
    }
    [[nodiscard]] double row_width() const { return (paper_.width() - 2.0 * kColumnGapMm) / 3.0; }
    // Of up to three drawings from this one on.
    [[nodiscard]] double row_height(const Step& step, std::size_t first) const {
        double high = 0.0;
        for (std::size_t k = first; k < std::min(first + 3, step.figures.size()); ++k) {
            const Figure& figure = step.figures[k];
            high =
                std::max(high, BookPages::figure_scale(figure, row_width(), kRowHighMm) * figure.height_mm);
        }
        return high;
    }
    [[nodiscard]] double height_of_step(const Step& step) {
        double beside = texts_height(step);
        if (has_beside(step)) {
            const Figure& figure = step.figures.front();
            beside = std::max(
                beside, BookPages::figure_scale(figure, figure_width(), kFigureHighMm) * figure.height_mm);
        }
        return 2.4 * kStepCapMm + scenes_height(step) + rows_height(step) + beside + 5.0;
    }

    bool step(const Step& step) {
        paper_.need(std::min(height_of_step(step), paper_.whole()));
        paper_.outline(step.title, chapter_);
        paper_.text(step.title, kStepCapMm, paper_.left(), paper_.width(), true);
        paper_.skip(0.4 * kStepCapMm);
        if (!show(step.scenes, step.captions, picture_width(), kStepPicture)) return false;
        if (!step.scenes.empty()) paper_.skip(1.0);
        rows(step);
        const double top = paper_.y();
        double low = top;
        if (has_beside(step)) {
            const double x = paper_.left() + paper_.width() - figure_width();
            low = top + paper_.figure(step.figures.front(), x, top, figure_width(),
                                      std::min(kFigureHighMm, paper_.room()));
        }
        texts(step);
        if (paper_.y() >= top) paper_.go_to(std::max(low, paper_.y()));
        paper_.skip(5.0);
        return true;
    }

    void rows(const Step& step) {
        if (has_beside(step) || step.figures.empty()) return;
        if (is_one_large(step)) {
            paper_.skip(
                paper_.figure(step.figures.front(), paper_.left(), paper_.y(), paper_.width(), kLargeHighMm));
        } else {
            small_rows(step);
        }
        if (!step.key.empty()) {
            paper_.skip(1.0);
            paper_.text(step.key, kBodyCapMm, paper_.left(), paper_.width(), false, 0.3);
        }
        paper_.skip(3.0);
    }
    void small_rows(const Step& step) {
        for (std::size_t i = 0; i < step.figures.size(); i += 3) {
            if (i > 0) paper_.skip(3.0);
            const double high = row_height(step, i);
            paper_.need(high);
            for (std::size_t k = i; k < std::min(i + 3, step.figures.size()); ++k)
                paper_.figure(step.figures[k],
                              paper_.left() + static_cast<double>(k - i) * (row_width() + kColumnGapMm),
                              paper_.y(), row_width(), kRowHighMm);
            paper_.skip(high);
        }
    }

    void texts(const Step& step) {
        const double wide = text_width(step);
        const double x = paper_.left();
        if (!step.lies.empty()) {
            paper_.text(step.lies, kBodyCapMm, x, wide, true);
            paper_.skip(1.0);
        }
        for (std::size_t i = 0; i < step.actions.size(); ++i) {
            paper_.need(BookPages::height(1, kBodyCapMm));
            const double y = paper_.y() + kBodyCapMm;
            paper_.line_at(fmt::format("{}", static_cast<char>('a' + static_cast<int>(i % 26))), kBodyCapMm,
                           x, y, true, 0.35);
            paper_.text(step.actions[i], kBodyCapMm, x + kBulletMm, wide - kBulletMm);
            paper_.skip(0.8);
        }
        for (const std::string& note : step.notes) {
            paper_.need(BookPages::height(1, kBodyCapMm));
            paper_.line_at("!", kBodyCapMm, x + 0.5, paper_.y() + kBodyCapMm, true, 0.35);
            paper_.text(note, kBodyCapMm, x + kBulletMm, wide - kBulletMm, false, 0.3);
            paper_.skip(0.8);
        }
    }

    bool closing(const CardPart& part) {
        if (part.opens.empty() && part.trouble.empty() && part.found.empty()) return true;
        chapter(part.closing_title, 110.0, CAIRO_PDF_OUTLINE_ROOT);
        if (!part.opening.empty()) {
            const double wide = (paper_.width() - 2.0 * kColumnGapMm) / 3.0;
            double x = paper_.left();
            const double high = height_of(wide, kSmallPicture);
            for (std::size_t i = 0; i < part.opening.size(); ++i) {
                const auto shown = pictures_.draw(std::span(part.opening).subspan(i, 1), kSmallPicture);
                if (!shown) return false;
                paper_.picture(shown->front().picture, shown->front().jpeg, x, paper_.y(), wide);
                paper_.line_at(part.opening_captions[i], kSmallCapMm, x,
                               paper_.y() + high + 1.7 * kSmallCapMm, false, 0.35);
                x += wide + kColumnGapMm;
            }
            paper_.skip(high + 3.0 * kSmallCapMm);
        }
        for (const std::string& text : part.opens) {
            paper_.text(text, kBodyCapMm, paper_.left(), paper_.width());
            paper_.skip(2.0);
        }
        section("When it does not", part.trouble);
        section("What popupc found", part.found);
        return true;
    }

    void section(const char* title, const std::vector<std::string>& texts) {
        if (texts.empty()) return;
        paper_.need(20.0);
        paper_.skip(2.0);
        paper_.text(title, kStepCapMm, paper_.left(), paper_.width(), true);
        paper_.skip(1.0);
        bullets(texts, false);
    }

    static constexpr double kRowHighMm = 30.0;
    BookPages& paper_;
    const Book& book_;
    Pictures& pictures_;
    int chapter_ = CAIRO_PDF_OUTLINE_ROOT;
};

}  // namespace
}  // namespace book

std::optional<std::string> book::pdf_of(const Book& book, std::span<const SceneCard> cards,
                                        Diagnostics& diagnostics) {
    const std::string bold_file = font_path(TextFont::sans_bold);
    const FontFace plain = open_font(POPUP_FONT_FILE);
    const FontFace bold = open_font(bold_file);
    if (plain == nullptr || bold == nullptr) {
        report_missing_font(plain == nullptr ? POPUP_FONT_FILE : bold_file, diagnostics);
        return std::nullopt;
    }
    Pictures pictures(cards, book.printed_backs, diagnostics);
    const Vec2 size = book.letter ? Vec2{215.9, 279.4} : Vec2{210.0, 297.0};
    bool drawn = false;
    std::optional<std::string> bytes = draw_document(
        visible(book.title + ": " + book.kind), size, plain.get(),
        [&](cairo_surface_t* surface, cairo_t* context, PaintedPictures&) {
            BookPages paper(surface, context, plain.get(), bold.get(), book.letter, book.title);
            drawn = Writer(paper, book, pictures).write();
            paper.finish();
        },
        diagnostics);
    return drawn ? bytes : std::nullopt;
}

std::optional<std::string> write_book_pdf(const RunPage& page, const OutputOptions& options,
                                          Diagnostics& diagnostics) {
    return book::pdf_of(book::make_book(page, options), page.cards, diagnostics);
}

}  // namespace popup
