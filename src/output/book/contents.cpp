// What is in a book.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "base/nth.h"
#include "base/text/numbers.h"
#include "gluing/glue_flaps.h"
#include "output/book/book.h"
#include "output/book/line_words.h"
#include "output/book/opening.h"
#include "output/book/panel_labels.h"
#include "output/book/steps.h"
#include "output/book/words.h"
#include "output/sheet_drawing.h"
#include "output/sheet_sides.h"

namespace popup::book {
namespace {

std::string mm_text(double width, double height) {
    return fmt::format("{} × {} mm", number_text(width, 1), number_text(height, 1));
}

// "A4", or its size.
std::string paper_name(const LayoutSheet& sheet) {
    for (const Paper& paper : paper_table()) {
        const auto [narrow, wide] = std::minmax(sheet.width_mm, sheet.height_mm);
        if (std::abs(narrow - paper.width_mm) > 0.6 || std::abs(wide - paper.height_mm) > 0.6) continue;
        std::string name(paper.name);
        if (name.size() == 2) name[0] = 'A';
        return fmt::format("{} ({})", name, mm_text(sheet.width_mm, sheet.height_mm));
    }
    return mm_text(sheet.width_mm, sheet.height_mm);
}

struct Figures {
    double cut_mm = 0.0;
    std::size_t folds = 0;
    bool has_inner_cuts = false;
};

Figures figures_of(const Layout& layout) {
    Figures all;
    for (const Placement& placement : layout.placements) {
        const PatternPiece& piece =
            nth(nth(layout.designs, placement.design).pattern.pieces, placement.piece);
        for (const Contour& cut : piece.cuts) {
            for (std::size_t i = 0; i + 1 < cut.points.size(); ++i)
                all.cut_mm += distance(cut.points[i], cut.points[i + 1]);
            if (cut.closed) all.cut_mm += distance(cut.points.back(), cut.points.front());
            all.has_inner_cuts = all.has_inner_cuts || !cut.closed || cut.depth > 0;
        }
        for (const PatternLine& line : piece.lines) {
            if (line.kind == LineKind::mountain || line.kind == LineKind::valley) ++all.folds;
        }
    }
    return all;
}

struct GlueCount {
    std::size_t tabs = 0, areas = 0, flaps = 0, rivets = 0;
};

int copies_of(const Layout& layout) {
    int copies = 1;
    for (const Placement& placement : layout.placements) copies = std::max(copies, placement.copy + 1);
    return copies;
}

// Of all copies, as figures_of().
GlueCount glue_of(std::span<const SceneCard> cards, const Layout& layout) {
    GlueCount all;
    for (const SceneCard& card : cards) {
        const std::vector<bool> tabs = tabs_on_sheets(card);
        all.tabs += static_cast<std::size_t>(std::count(tabs.begin(), tabs.end(), true));
        all.areas += card.assembly->glued_areas.size();
        all.flaps += glue_flaps(*card.assembly).size();
        for (const Plate& plate : card.assembly->plates) all.rivets += plate.rivet ? 1U : 0U;
    }
    const auto copies = static_cast<std::size_t>(copies_of(layout));
    for (std::size_t* const count : {&all.tabs, &all.areas, &all.flaps, &all.rivets}) *count *= copies;
    return all;
}

void add_needs(const RunPage& page, const OutputOptions& options, Book& book) {
    const Layout& layout = *page.layout;
    std::map<std::string, std::size_t> papers;
    std::vector<std::string> order;
    for (const LayoutSheet& sheet : layout.sheets) {
        const std::string name = paper_name(sheet);
        if (papers[name]++ == 0) order.push_back(name);
    }
    std::vector<std::string> sheets;
    sheets.reserve(order.size());
    for (const std::string& name : order)
        sheets.push_back(fmt::format("{} of {}", counted(papers[name], "sheet", "sheets"), name));
    book.needs.emplace_back("Paper", listed(sheets) + ", stiff: 160 to 240 g/m²");
    if (options.tile)
        book.needs.emplace_back("Print",
                                fmt::format("the sheets on several pages of {}, glued together first: each "
                                            "sheet's plan says how",
                                            mm_text(options.tile->width_mm, options.tile->height_mm)));
    const Figures figures = figures_of(layout);
    const GlueCount glue = glue_of(page.cards, *page.layout);
    std::vector<std::string> tools;
    tools.emplace_back(figures.has_inner_cuts ? "a sharp knife, a cutting mat, scissors" : "scissors");
    if (figures.folds > 0) tools.emplace_back("a ruler, a blunt point to score folds");
    if (glue.tabs + glue.areas + glue.flaps > 0) tools.emplace_back("glue that does not warp paper");
    if (glue.rivets > 0)
        tools.push_back(counted(glue.rivets, "brad (a paper fastener)", "brads (paper fasteners)"));
    book.needs.emplace_back("Tools", fmt::format("{}", fmt::join(tools, ", ")));
    book.needs.emplace_back("To cut", fmt::format("{} m of lines", number_text(figures.cut_mm / 1000.0, 1)));
    if (figures.folds > 0) book.needs.emplace_back("To fold", counted(figures.folds, "fold", "folds"));
    std::vector<std::string> spots;
    if (glue.tabs > 0) spots.push_back(counted(glue.tabs, "tab", "tabs"));
    if (glue.areas > 0) spots.push_back(counted(glue.areas, "area", "areas"));
    if (glue.flaps > 0) spots.push_back(counted(glue.flaps, "flap", "flaps"));
    if (!spots.empty()) book.needs.emplace_back("To glue", listed(spots));
    const int copies = copies_of(layout);
    if (copies > 1)
        book.needs.emplace_back(
            "Copies", fmt::format("the sheets have {} of each piece, and the numbers above are for all of "
                                  "them; the steps make one card of one of each, and are done {} times",
                                  copies, copies));
}

void add_first(const RunPage& page, const OutputOptions& options, Book& book) {
    const Figures figures = figures_of(*page.layout);
    const GlueCount glue = glue_of(page.cards, *page.layout);
    book.first = line_words(options.profile, {figures.folds > 0, figures.has_inner_cuts});
    if (glue.tabs > 0) {
        const bool has_targets =
            options.profile.draws(Operation::glue) || options.profile.draws(Operation::mark);
        book.first.push_back(fmt::format(
            "Fold every tab back, away from the printed side. {}",
            has_targets
                ? "A tab belongs on the target with its number."
                : "These sheets mark no targets: a tab belongs where the pictures of the steps show it."));
    }
    if (options.backs && glue.tabs + glue.areas > 0)
        book.first.emplace_back(
            "Targets and numbers are printed on the backs of the sheets, behind their places. Where "
            "something "
            "is glued on a front, prick the corners of its target through before you cut.");
    if (glue.tabs + glue.areas > 0)
        book.first.emplace_back(
            "Glue in the order of the steps; the numbers on tabs and pieces only tell what belongs "
            "together. Use little glue, and let each step set before the next.");
}

void add_sheets(const RunPage& page, Book& book) {
    const Layout& layout = *page.layout;
    for (std::size_t i = 0; i < layout.sheets.size(); ++i) {
        SheetPart& part = book.sheets.emplace_back();
        std::size_t pieces = 0;
        for (const Placement& placement : layout.placements) {
            if (placement.sheet == static_cast<int>(i)) ++pieces;
        }
        part.title = fmt::format("Sheet {} of {}: {}, {}", i + 1, layout.sheets.size(),
                                 counted(pieces, "piece", "pieces"), paper_name(layout.sheets[i]));
        part.figure = sheet_figure(layout, static_cast<int>(i));
        part.figure.alt = part.title;
        part.key = settle_labels(part.figure);
    }
}

std::vector<PartRow> parts_of(const SceneCard& card, const Layout& layout, std::size_t number) {
    const Words words(card);
    const Assembly& assembly = *card.assembly;
    std::vector<std::set<int>> sheets(assembly.pieces.size());
    for (const Placement& placement : layout.placements) {
        if (placement.design == static_cast<int>(number))
            nth(sheets, placement.piece).insert(placement.sheet + 1);
    }
    std::vector<std::string> tabs(assembly.pieces.size());
    const auto add_tab = [&](int plate, const std::string& label) {
        std::string& of_piece = nth(tabs, nth(assembly.plates, plate).piece);
        of_piece += (of_piece.empty() ? "" : ", ") + label;
    };
    const std::vector<bool> there = tabs_on_sheets(card);
    for (std::size_t i = 0; i < assembly.glue.size(); ++i) {
        if (there[i]) add_tab(assembly.glue[i].piece_plate, assembly.glue[i].label);
    }
    for (const GluedArea& glued : assembly.glued_areas) add_tab(glued.plate, "area " + glued.label);
    std::vector<PartRow> rows;
    for (std::size_t i = 0; i < assembly.pieces.size(); ++i) {
        const auto piece = static_cast<int>(i);
        std::vector<std::string> on;
        for (const int sheet : sheets[i]) on.push_back(std::to_string(sheet));
        rows.push_back(
            {words.number(piece), assembly.pieces[i].name, listed(on), words.fold_count(piece), tabs[i]});
    }
    return rows;
}

std::string title_of(std::span<const SceneCard> cards) {
    std::vector<std::string> names;
    for (const SceneCard& card : cards) names.push_back(card.assembly->stem);
    return listed(names, 3);
}

}  // namespace

Book make_book(const RunPage& page, const OutputOptions& options) {
    Book book;
    book.letter = options.letter_pages.value_or(page.inches);
    book.printed_backs = options.backs;
    book.title = title_of(page.cards);
    book.subtitle = "Assembly book";
    add_needs(page, options, book);
    add_first(page, options, book);
    add_sheets(page, book);
    for (std::size_t i = 0; i < page.cards.size(); ++i) {
        const SceneCard& card = page.cards[i];
        CardPart part;
        part.title = card.assembly->stem;
        part.parts = parts_of(card, *page.layout, i);
        part.chapters = chapters_of(card, i, are_backs_marked(options));
        add_opening(card, i, page.findings, part);
        if (has_model(*card.assembly)) {
            Scene cover;
            cover.card = i;
            cover.as_still = true;
            if (card.assembly->covers.empty()) cover.opening_deg = card.assembly->sweep.from_deg;
            cover.alt = fmt::format("{}, finished", card.assembly->stem);
            book.cover.push_back(std::move(cover));
        }
        book.cards.push_back(std::move(part));
    }
    return book;
}

}  // namespace popup::book
