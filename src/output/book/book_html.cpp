#include "output/book/book_html.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include "base/text/base64.h"
#include "base/text/numbers.h"
#include "output/book/book.h"
#include "output/book/page_files.h"
#include "output/book/pictures.h"
#include "output/html_page.h"
#include "output/markup.h"
#include "output/sheet_drawing.h"

namespace popup {
namespace book {
namespace {

constexpr std::size_t kMostBookBytes = 400'000'000;
constexpr int kFigureDecimals = 2;
constexpr double kShownMm = 76.0;  // how wide and how high most drawings are shown at most

class Page {
 public:
    Page(const Book& book, Pictures& pictures) : book_(book), pictures_(pictures) {}

    bool write() {
        if (!cover()) return false;
        begin(book_.needs_title);
        add("<dl>\n");
        for (const auto& [name, value] : book_.needs)
            add("<dt>{}</dt><dd>{}</dd>\n", told_html(name), told_html(value));
        add("</dl>\n");
        if (!book_.first.empty()) begin("Before you begin");
        list("ul", book_.first);
        sheets();
        if (!std::all_of(book_.cards.begin(), book_.cards.end(),
                         [this](const CardPart& part) { return card(part); }))
            return false;
        add("</main>\n");
        return true;
    }
    [[nodiscard]] const std::string& body() const { return body_; }
    [[nodiscard]] const std::string& header() const { return header_; }
    [[nodiscard]] std::string contents() const {
        std::string html = "<nav aria-label=\"Contents\">\n<ol>\n";
        for (std::size_t i = 0; i < chapters_.size(); ++i)
            html += fmt::format("<li><a href=\"#c{}\">{}</a></li>\n", i + 1, told_html(chapters_[i]));
        return html + "</ol>\n</nav>\n";
    }

 private:
    template <typename... Values>
    void add(fmt::format_string<Values...> text, Values&&... values) {
        fmt::format_to(std::back_inserter(body_), text, std::forward<Values>(values)...);
    }

    void begin(const std::string& title) {
        chapters_.push_back(title);
        add("<h2 id=\"c{}\">{}</h2>\n", chapters_.size(), told_html(title));
    }

    void list(std::string_view kind, const std::vector<std::string>& texts) {
        if (texts.empty()) return;
        add("<{}>\n", kind);
        for (const std::string& text : texts) add("<li>{}</li>\n", told_html(text));
        add("</{}>\n", kind.substr(0, kind.find(' ')));
    }

    static std::string number(double value) { return number_text(value, kFigureDecimals); }

    // An estimate that is hardly ever too small: letters of fonts differ.
    static double width_of(const std::string& text, double cap) {
        return cap * (0.86 * static_cast<double>(std::max<std::size_t>(text.size(), 1)) + 0.7);
    }
    // A text on a white plate.
    static std::string badge(const std::string& text, double x, double y, double cap) {
        const double wide = width_of(text, cap);
        return fmt::format(
            "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"{}\" fill=\"#fff\" "
            "fill-opacity=\"0.86\"/><text "
            "x=\"{}\" y=\"{}\" text-anchor=\"middle\" font-family=\"system-ui, sans-serif\" "
            "font-weight=\"700\" "
            "font-size=\"{}\" fill=\"#111\">{}</text>",
            number(x - 0.5 * wide), number(y - 0.95 * cap), number(wide), number(1.9 * cap),
            number(0.3 * cap), number(x), number(y + 0.5 * cap), number(1.37 * cap), told_html(text));
    }

    static std::string drawing(const Figure& figure, double shown_mm) {
        // How many of the drawing's millimetres are one of the page.
        const double coarse = std::max({1.0, figure.width_mm / shown_mm, figure.height_mm / shown_mm});
        std::string svg =
            fmt::format("<svg width=\"{}mm\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">",
                        number(figure.width_mm / coarse), number(figure.width_mm), number(figure.height_mm),
                        told_html(figure.alt));
        for (const Figure::Shape& shape : figure.shapes) {
            std::string path;
            for (const std::vector<Vec2>& line : shape.lines) {
                const char* letter = "M";
                for (const Vec2 p : line) {
                    path += fmt::format("{}{} {}", letter, number(p.x), number(p.y));
                    letter = "L";
                }
                if (shape.closed) path += "Z";
            }
            svg += fmt::format("<path d=\"{}\" fill=\"{}\" fill-rule=\"evenodd\"", path,
                               shape.fill ? to_string(*shape.fill) : std::string("none"));
            if (shape.ink) {
                const InkLook& look = look_of(*shape.ink);
                svg += fmt::format(" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\"",
                                   to_string(look.color), number(coarse * look.width_mm));
                if (look.dashes_mm[0] > 0.0) {
                    svg += " stroke-dasharray=\"";
                    for (const double mm : look.dashes_mm) svg += number(coarse * mm) + " ";
                    svg.back() = '"';
                }
            }
            svg += "/>";
        }
        for (const Figure::Label& label : figure.labels) {
            const double cap = 2.0 * coarse;
            const bool tight = !label.brief.empty() && width_of(label.text, cap) > label.room_mm;
            svg += badge(tight ? label.brief : label.text, label.at.x, label.at.y, cap);
        }
        return svg + "</svg>";
    }

    bool show(std::span<const Scene> scenes, std::span<const std::string> captions, PictureSize size,
              std::string& html) {
        const auto shown = pictures_.draw(scenes, size);
        if (!shown) return false;
        for (std::size_t i = 0; i < shown->size(); ++i) {
            const Picture& picture = (*shown)[i].picture;
            html += fmt::format(
                "<figure><svg viewBox=\"0 0 {0} {1}\" role=\"img\" aria-label=\"{2}\"><image width=\"{0}\" "
                "height=\"{1}\" href=\"data:image/jpeg;base64,{3}\"/>",
                picture.pixels.width, picture.pixels.height, told_html(scenes[i].alt),
                base64((*shown)[i].jpeg));
            for (const PictureMark& mark : picture.marks)
                html += badge(mark.text, mark.x * picture.pixels.width, mark.y * picture.pixels.height,
                              0.022 * picture.pixels.width);
            html += "</svg>";
            if (i < captions.size())
                html += fmt::format("<figcaption>{}</figcaption>", told_html(captions[i]));
            html += "</figure>\n";
        }
        return true;
    }

    bool cover() {
        header_ = fmt::format("<header>\n<h1>{}</h1>\n<p class=\"subtitle\">{}</p>\n", told_html(book_.title),
                              told_html(book_.subtitle));
        if (!book_.cover.empty()) header_ += "<div class=\"pictures cover\">\n";
        for (const Scene& one : book_.cover) {
            if (!show({&one, 1}, {}, kCoverPicture, header_)) return false;
        }
        header_ += book_.cover.empty() ? "</header>\n" : "</div>\n</header>\n";
        add("<main>\n");
        return true;
    }

    void sheets() {
        if (book_.sheets.empty()) return;
        begin("The sheets");
        for (const SheetPart& sheet : book_.sheets)
            add("<figure class=\"sheet\">{}<figcaption>{}{}</figcaption></figure>\n",
                drawing(sheet.figure, 190.0), told_html(sheet.title),
                sheet.key.empty() ? std::string() : "<br>" + told_html(sheet.key));
    }

    void pieces(const CardPart& part, const std::string& of) {
        if (part.parts.empty()) return;
        begin(of + "Pieces");
        add("<table>\n<thead><tr><th scope=\"col\">No.</th><th scope=\"col\">Piece</th><th "
            "scope=\"col\">Sheet</th><th "
            "scope=\"col\">Folds</th><th scope=\"col\">Tabs</th></tr></thead>\n<tbody>\n");
        for (const PartRow& row : part.parts)
            add("<tr><td>{}</td><th scope=\"row\">{}</th><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                told_html(row.number), told_html(row.name), told_html(row.sheets), told_html(row.folds),
                told_html(row.tabs));
        add("</tbody>\n</table>\n");
    }

    bool card(const CardPart& part) {
        const std::string of = book_.cards.size() > 1 ? part.title + ": " : std::string();
        pieces(part, of);
        for (const Chapter& chapter : part.chapters) {
            if (chapter.steps.empty()) continue;
            begin(of + chapter.title);
            if (!chapter.intro.empty()) add("<p>{}</p>\n", told_html(chapter.intro));
            for (const Step& one : chapter.steps) {
                if (!step(one)) return false;
            }
        }
        return closing(part, of);
    }

    bool step(const Step& step) {
        add("<article>\n<h3>{}</h3>\n", told_html(step.title));
        if (!step.scenes.empty()) {
            add("<div class=\"pictures\">\n");
            if (!show(step.scenes, step.captions, kStepPicture, body_)) return false;
            add("</div>\n");
        }
        if (!step.figures.empty()) {
            const bool large = step.large_figures && step.figures.size() == 1;
            add("<div class=\"{}\">\n", large ? "large" : "drawings");
            for (const Figure& figure : step.figures)
                add("<figure>{}</figure>\n", drawing(figure, large ? 2.0 * kShownMm : kShownMm));
            add("</div>\n");
            if (!step.key.empty()) add("<p>{}</p>\n", told_html(step.key));
        }
        if (!step.lies.empty()) add("<p class=\"lies\">{}</p>\n", told_html(step.lies));
        list(step.lettered ? "ol class=\"letters\"" : "ol", step.actions);
        for (const std::string& note : step.notes) add("<p class=\"note\">{}</p>\n", told_html(note));
        add("</article>\n");
        return true;
    }

    bool closing(const CardPart& part, const std::string& of) {
        if (part.opens.empty() && part.trouble.empty() && part.found.empty()) return true;
        begin(of + part.closing_title);
        if (!part.opening.empty()) {
            add("<div class=\"pictures\">\n");
            for (std::size_t i = 0; i < part.opening.size(); ++i) {
                if (!show({&part.opening[i], 1}, {&part.opening_captions[i], 1}, kSmallPicture, body_))
                    return false;
            }
            add("</div>\n");
        }
        for (const std::string& text : part.opens) add("<p>{}</p>\n", told_html(text));
        if (!part.trouble.empty()) add("<h3>When it does not</h3>\n");
        list("ul", part.trouble);
        if (!part.found.empty()) add("<h3>What popupc found</h3>\n");
        list("ul", part.found);
        return true;
    }

    const Book& book_;
    Pictures& pictures_;
    std::string header_, body_;
    std::vector<std::string> chapters_;
};

}  // namespace
}  // namespace book

std::optional<std::string> book::html_of(const Book& book, std::span<const SceneCard> cards,
                                         Diagnostics& diagnostics) {
    Pictures pictures(cards, book.printed_backs, diagnostics);
    Page made(book, pictures);
    if (!made.write()) return std::nullopt;
    const std::string style = "\n" + std::string(page_file(book_files(), "book.css"));
    const std::string policy =
        fmt::format("default-src 'none'; style-src {}; img-src data:; base-uri 'none'; form-action 'none'",
                    policy_source(style));
    std::string html =
        page_head(policy, told_html(book.title) + ": " + told_html(book.kind), style) + "<body>\n";
    html += made.header() + made.contents() + made.body();
    html += fmt::format("<footer>{}</footer>\n</body>\n</html>\n", generator());
    if (html.size() <= kMostBookBytes) return html;
    diagnostics
        .error(
            "model-too-large", {},
            fmt::format("the book would be {:.0f} MB, {:.0f} MB are the most",
                        1e-6 * static_cast<double>(html.size()), 1e-6 * static_cast<double>(kMostBookBytes)))
        .hint("write fewer designs into one book, or a .book.pdf");
    return std::nullopt;
}

std::optional<std::string> write_book_html(const RunPage& page, const OutputOptions& options,
                                           Diagnostics& diagnostics) {
    return book::html_of(book::make_book(page, options), page.cards, diagnostics);
}

}  // namespace popup
