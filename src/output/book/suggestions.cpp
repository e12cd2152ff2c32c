#include "output/book/suggestions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/nth.h"
#include "output/book/book.h"
#include "output/book/book_html.h"
#include "output/book/book_pdf.h"
#include "output/book/words.h"

namespace popup::book {
namespace {

constexpr double kTouchesMm = 0.005;
constexpr double kRimMm = 1.0;  // around the drawing of the sheet
// Panels in the order of their letters: pale tints of the colours that they have in pictures.
constexpr std::array<Color, 4> kTints{Color{255, 205, 170}, Color{187, 214, 250}, Color{190, 230, 190},
                                      Color{228, 204, 243}};
constexpr Color kSheetFill{253, 252, 249};

struct Kind {
    JoinKind kind;
    std::string_view title, intro;
};
constexpr std::array<Kind, kJoinKindNames.size()> kKinds{
    {{JoinKind::merge, "Corners to merge",
      "Corners of different panels that are near each other. Each has a dot, and lines lead to their "
      "middle."},
     {JoinKind::paste, "Panels to paste", "The first panel is to lie on the second."},
     {JoinKind::coplanar, "Panels to lay in one plane", "The panels are to lie beside each other."},
     {JoinKind::glue, "Panels to glue",
      "The first panel lies on the second. Accept it where glue holds it there, so that the assembly book "
      "tells of it."}}};

std::string letter_of(std::size_t number) {
    return {static_cast<char>('a' + static_cast<char>(number % 26))};
}

std::string distance_text(const Suggestion& row) {
    if (row.lies())
        return row.apart_mm < kTouchesMm ? std::string("lies on it")
                                         : fmt::format("lies {} from it", shown_gap(row.apart_mm));
    return fmt::format("{} apart; accepting it {}", shown_gap(row.apart_mm), shown_outcome(row));
}

std::string turn_text(const FoldTurn& turn) {
    std::string text = shown_turn(turn) + ".";
    text.front() = 'T';
    return text;
}

class Maker {
 public:
    explicit Maker(const SuggestionsOf& of) : of_(of) {
        const std::vector<Plate>& plates = of.card.assembly->plates;
        for (std::size_t i = 0; i < plates.size(); ++i) {
            plates_.emplace(plates[i].name, static_cast<int>(i));
            for (const Vec2 p : plates[i].outline.outer) sheet_.extend(p);
        }
    }

    Book make() {
        Book book;
        book.kind = "suggestions";
        book.needs_title = "What was found";
        book.title = of_.title;
        book.subtitle = "What of it should meet";
        book.letter = of_.letter;
        Scene cover = scene();
        cover.as_still = true;
        cover.alt = "The sheet as it is folded now";
        book.cover.push_back(std::move(cover));
        add_figures(book);
        CardPart& part = book.cards.emplace_back();
        part.title = of_.title;
        for (const Kind& kind : kKinds) {
            Chapter chapter{std::string(kind.title), std::string(kind.intro), {}};
            for (const Suggestion& row : of_.found.rows) {
                if (row.join.kind == kind.kind) chapter.steps.push_back(step(row));
            }
            if (!chapter.steps.empty()) part.chapters.push_back(std::move(chapter));
        }
        return book;
    }

 private:
    void add_figures(Book& book) const {
        const Suggestions& found = of_.found;
        book.needs = {{"Suggestions", std::to_string(found.rows.size())},
                      {"Within", fmt::format("{:.1f} mm", found.near_mm)},
                      {"Met already", counted(found.met.size(), "place", "places")}};
        if (found.left_out > 0) book.needs.emplace_back("Left out", std::to_string(found.left_out));
        if (!found.rows.empty()) {
            book.needs.emplace_back(
                "To accept", fmt::format("popupc suggest … --accept \"{}\"", found.rows.front().name()));
        }
    }

    [[nodiscard]] Scene scene() const {
        Scene scene;
        scene.opening_deg = of_.card.assembly->sweep.from_deg;
        return scene;
    }

    [[nodiscard]] Step step(const Suggestion& row) const {
        Step step;
        step.title = row.name();
        step.lies = distance_text(row);
        step.lettered = true;
        Scene shown = scene();
        std::vector<std::string> names;
        for (std::size_t i = 0; i < row.join.parts.size(); ++i) {
            const JoinPart& part = row.join.parts[i];
            const bool is_merge = row.join.kind == JoinKind::merge;
            names.push_back(part.panel);
            step.actions.push_back(is_merge ? fmt::format("{}, the corner at {}", part.panel,
                                                          shown_point(of_.ruler, part.corner))
                                            : part.panel);
            const auto plate = plates_.find(part.panel);
            if (plate == plates_.end()) continue;
            Scene::Marked& marked = shown.marked.emplace_back();
            marked.plate = plate->second;
            marked.text = letter_of(i);
            if (is_merge) marked.corner = part.corner;
        }
        shown.alt = fmt::format("The folded sheet, on which {} are marked", listed(names));
        step.figures.push_back(figure(shown));
        step.scenes.push_back(std::move(shown));
        if (!row.furthest.panels[0].empty()) step.notes.push_back(turn_text(row.furthest));
        if (!row.like.empty())
            step.notes.push_back(
                fmt::format("Like merge {}: accepted with it where it closes, unless --alone is given.",
                            fmt::join(row.like, ", ")));
        return step;
    }

    // The flat sheet.
    [[nodiscard]] Figure figure(const Scene& shown) const {
        const Assembly& assembly = *of_.card.assembly;
        Figure figure;
        figure.width_mm = sheet_.width() + 2.0 * kRimMm;
        figure.height_mm = sheet_.height() + 2.0 * kRimMm;
        figure.alt = "The flat sheet, with the same panels";
        const auto at = [&](Vec2 p) {
            return Vec2{p.x - sheet_.min.x + kRimMm, sheet_.max.y - p.y + kRimMm};
        };
        const auto add = [&](const Plate& plate, Color fill, Ink ink) {
            Figure::Shape& shape = figure.shapes.emplace_back();
            shape.lines = {plate.outline.outer};
            shape.lines.insert(shape.lines.end(), plate.outline.holes.begin(), plate.outline.holes.end());
            for (std::vector<Vec2>& line : shape.lines)
                std::transform(line.begin(), line.end(), line.begin(), at);
            shape.closed = true;
            shape.fill = fill;
            shape.ink = ink;
        };
        for (const Plate& plate : assembly.plates) add(plate, kSheetFill, Ink::faint);
        for (std::size_t i = 0; i < shown.marked.size(); ++i) {
            const Scene::Marked& one = shown.marked[i];
            const Plate& plate = nth(assembly.plates, one.plate);
            add(plate, kTints.at(i % kTints.size()), Ink::edge);
            const Vec2 middle = inner_point(plate.outline, 0.5).at;
            figure.labels.push_back({one.text, at(middle), {}, 0.0});
            if (!one.corner) continue;
            const double size = 0.012 * std::max(figure.width_mm, figure.height_mm);
            const Vec2 p = at(*one.corner);
            figure.shapes.push_back(
                {{{p + Vec2{size, 0}, p + Vec2{0, size}, p - Vec2{size, 0}, p - Vec2{0, size}}},
                 true,
                 look_of(Ink::accent).color,
                 Ink::accent});
        }
        return figure;
    }

    const SuggestionsOf& of_;
    std::map<std::string, int> plates_;  // by name
    Box sheet_;
};

}  // namespace

Book book_of(const SuggestionsOf& suggestions) { return Maker(suggestions).make(); }

std::optional<std::string> suggestions_html(const SuggestionsOf& suggestions, Diagnostics& diagnostics) {
    return html_of(book_of(suggestions), {&suggestions.card, 1}, diagnostics);
}
std::optional<std::string> suggestions_pdf(const SuggestionsOf& suggestions, Diagnostics& diagnostics) {
    return pdf_of(book_of(suggestions), {&suggestions.card, 1}, diagnostics);
}

}  // namespace popup::book
