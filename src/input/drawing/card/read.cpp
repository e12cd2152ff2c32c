#include "input/drawing/card/read.h"

#include <fmt/format.h>

#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include "base/geometry/mend_ends.h"
#include "base/nth.h"
#include "input/drawing/card/features.h"
#include "input/drawing/card/leftovers.h"
#include "input/drawing/card/lines.h"
#include "input/drawing/card/origamic_card.h"
#include "input/drawing/card/page.h"
#include "input/drawing/card/to_design.h"

namespace popup::drawing::card {
namespace {

// Findings about features, each with its place.
class Teller {
 public:
    Teller(const Tracing& tracing, const SheetGraph& graph, Diagnostics& diagnostics)
        : tracing_(tracing), graph_(graph), diagnostics_(diagnostics) {}

    // What elements are not found of, and what they change. `why`: what keeps the card from being folded as
    // it is drawn, if anything does.
    void tell_elements(const Features& features, const Leftovers& left, const NotUnderstood& why) {
        for (const std::vector<NotUnderstood>* faults : {&features.faults, &left.faults}) {
            for (const NotUnderstood& one : *faults) tell_fault(one);
        }
        if (!left.cuts_within.empty() && !why.what.empty()) {
            tell_fault(
                {why.element,
                 "cuts within its plates say that this card is to be folded as it is drawn, but " + why.what,
                 why.at, "--as folded makes a model of any sheet"});
        } else {
            for (const NotUnderstood& one : left.cuts_within) tell_fault(one);
        }
        for (const NotUnderstood& one : left.run_on) {
            tell_drawn_on(one, "a feature that stands on it", "end the fold at the cuts of the feature");
        }
        tell_ways(left.as_drawn, left.other_way);
    }

    // What is no paper of the card.
    void tell_rest(const Features& features, const Leftovers& left) {
        for (const NotUnderstood& one : features.over_folds) {
            diagnostics_
                .remark("hole-over-fold", place(one),
                        "this outline lies across a fold and has no fold in it: it is a hole")
                .hint("draw the fold on through it, or its own folds in it, if it is to pop up");
        }
        for (const NotUnderstood& one : features.beside_folds) {
            diagnostics_
                .remark("hole-beside-fold", place(one),
                        "this closed cut has a side on a fold: it is a hole, and nothing folds along it")
                .hint("leave that side out of the cut if the paper is to hang there");
        }
        for (const NotUnderstood& one : left.islands) {
            diagnostics_
                .warning("island", place(one),
                         "this lies in a hole and falls out with it" + at(one) + "; it is not cut")
                .hint("join it to the paper around, or take it out");
        }
        for (const NotUnderstood& one : left.cuts_on_folds) {
            diagnostics_
                .warning("cut-on-fold", place(one),
                         one.what + " of this fold are drawn as a cut, too, from" + at(one).substr(4) +
                             "; it stays a fold, and is not cut there")
                .hint("draw the cut beside the fold, or end the fold where the cut begins")
                .changed("a fold and a cut on it", "the fold");
        }
        if (!left.outside.empty()) {
            const std::size_t count = left.outside.size();
            diagnostics_
                .warning("outside-page", place(left.outside.front()),
                         fmt::format("{} element{} outside of the page, and {} no part of the card", count,
                                     count == 1 ? " lies" : "s lie", count == 1 ? "is" : "are"))
                .hint("a drawing is one card; its page is what surrounds most");
        }
    }

    // Folds that are drawn as the kind that they are, and as the other: edges.
    void tell_ways(const std::vector<int>& as_drawn, const std::vector<int>& other_way) {
        if (other_way.empty()) return;
        unsigned kinds = 0;
        for (const std::vector<int>* edges : {&as_drawn, &other_way}) {
            for (const int edge : *edges) kinds |= nth(graph_.edges, edge).ink & (kMountain | kValley);
        }
        // Where all are drawn as one kind, it says no more than that they are folds.
        if (!as_drawn.empty() && kinds != (kMountain | kValley)) return;
        const GraphEdge& first = nth(graph_.edges, other_way.front());
        const Place where = nth(tracing_.elements, first.element).place;
        const std::size_t wrong = other_way.size();
        if (as_drawn.empty()) {
            diagnostics_
                .remark("folds-exchanged", where,
                        "all mountain folds are drawn as valleys and all valley folds as mountains; the card "
                        "is seen from the side to which it opens")
                .hint("draw the gutter as a valley fold");
            return;
        }
        diagnostics_
            .warning("fold-other-way", where,
                     fmt::format(
                         "{} of {} stretches of folds {} drawn as the other kind than {} must be, the first "
                         "at {}",
                         wrong, wrong + as_drawn.size(), wrong == 1 ? "is" : "are",
                         wrong == 1 ? "it" : "they", shown_point(tracing_.ruler, graph_.at(first.a))))
            .hint(
                "folds that hold a feature go the way of the fold it stands on, its middle fold the other "
                "way");
    }

    void tell_drawn_on(const NotUnderstood& one, std::string_view through, std::string hint) {
        diagnostics_
            .warning("fold-drawn-on", place(one),
                     fmt::format("this fold is drawn on through {}, from{}; that stretch was left out",
                                 through, at(one).substr(4)))
            .hint(std::move(hint))
            .changed("a fold through the paper", "a fold up to the cuts");
    }

    void tell_origamic(const OrigamicCard& card) {
        const std::size_t plates = card.assembly.plates.size() - 2;  // beside the halves of the page
        std::string what = "this card is not made of elements; it is folded as it is drawn";
        if (plates > 0) {
            what += fmt::format(", {} plate{} the two halves of the page", plates,
                                plates == 1 ? " that stays parallel to" : "s that stay parallel to");
        }
        diagnostics_.remark("card-of-no-elements", {}, std::move(what))
            .hint("no document can be written of it: change the drawing to change the card");
        if (card.off > kSilentMm) {
            diagnostics_
                .warning(
                    "fold-straightened", nth(tracing_.elements, card.off_element).place,
                    fmt::format("folds of this card are up to {:.2f} mm off those that fold flat; they were "
                                "moved there",
                                card.off))
                .changed("folds as they are drawn", "folds at one distance from the gutter, each");
        }
        tell_ways(card.as_drawn, card.other_way);
    }

 private:
    void tell_fault(const NotUnderstood& one) {
        Diagnostic& told = diagnostics_.error("not-understood", place(one), one.what + at(one));
        if (!one.hint.empty()) told.hint(one.hint);
        told.hint(
            "mend the drawing there; what is no part of the card is left out with --lines ignore=NAME, of a "
            "layer, "
            "class, id or colour");
    }

    [[nodiscard]] Place place(const NotUnderstood& one) const {
        return nth(tracing_.elements, one.element).place;
    }
    [[nodiscard]] std::string at(const NotUnderstood& one) const {
        return ", at " + shown_point(tracing_.ruler, one.at);
    }

    const Tracing& tracing_;
    const SheetGraph& graph_;
    Diagnostics& diagnostics_;
};

// What is drawn.
struct Drawn {
    const Tracing& tracing;
    CardLines lines;
    std::vector<Segment> moves;  // of ends
};

// What its lines enclose.
struct Sheet {
    SheetGraph graph;
    CardPage page;
    Features features;
    Leftovers left;

    [[nodiscard]] bool has_faults() const {
        return !features.faults.empty() || !left.faults.empty() || !left.cuts_within.empty();
    }
};

std::optional<Sheet> sheet_of(const Tracing& tracing, std::optional<SheetGraph> graph,
                              Diagnostics& diagnostics) {
    const auto page = graph ? find_page(tracing, *graph, diagnostics) : std::nullopt;
    if (!page) return std::nullopt;
    Features features = find_features(*graph, *page);
    Leftovers left = find_leftovers(*graph, features);
    return Sheet{*std::move(graph), *page, std::move(features), std::move(left)};
}

// A card of no elements, and what is said of it.
std::optional<Assembly> read_origamic(const Drawn& drawn, const Sheet& sheet, NotUnderstood& why,
                                      Diagnostics& diagnostics) {
    auto card = origamic_card(drawn.tracing, sheet.graph, sheet.page, sheet.features, drawn.lines.printed,
                              drawn.moves, why);
    if (!card) return std::nullopt;
    Teller teller(drawn.tracing, sheet.graph, diagnostics);
    teller.tell_rest(sheet.features, sheet.left);
    teller.tell_origamic(*card);
    return std::move(card->assembly);
}

// The same where folds are drawn on through plates, without these stretches.
std::optional<Assembly> read_without(const std::vector<int>& stretches, const Drawn& drawn,
                                     const Sheet& sheet, Diagnostics& diagnostics) {
    if (stretches.empty()) return std::nullopt;
    Diagnostics unheard(diagnostics.file());
    NotUnderstood why;
    const auto rest =
        sheet_of(drawn.tracing, make_graph(without(drawn.lines.lines, sheet.graph, stretches)), unheard);
    auto card = rest ? read_origamic(drawn, *rest, why, diagnostics) : std::nullopt;
    if (!card) return std::nullopt;
    std::set<int> told;  // lines
    for (const int stretch : stretches) {
        const GraphEdge& edge = nth(sheet.graph.edges, stretch);
        if (!told.insert(edge.line).second) continue;
        Teller(drawn.tracing, sheet.graph, diagnostics)
            .tell_drawn_on({edge.element, {}, sheet.graph.at(edge.a)}, "the paper beyond a cut",
                           "end the fold at the cut");
    }
    return card;
}

// A card that is folded as it is drawn. Without one nothing is said, and `why` has what is in the way.
std::optional<Assembly> as_drawn(const Drawn& drawn, const Sheet& sheet, NotUnderstood& why,
                                 Diagnostics& diagnostics) {
    auto card = read_origamic(drawn, sheet, why, diagnostics);
    if (card) return card;
    return read_without(folds_drawn_on(sheet.graph, sheet.page, sheet.features), drawn, sheet, diagnostics);
}

enum class Tried { elements, all };

CardReading read(const Tracing& tracing, const Source& source, Tried tried, Diagnostics& diagnostics) {
    CardReading made;
    Drawn drawn{tracing, card_lines(tracing, diagnostics), {}};
    const auto sheet =
        sheet_of(tracing, join_ends(tracing, drawn.lines.lines, drawn.moves, diagnostics), diagnostics);
    if (!sheet) return made;
    Diagnostics of_assembly = diagnostics;
    NotUnderstood why;
    const bool whole = sheet->has_faults() || sheet->left.beyond_elements;
    if (whole && tried == Tried::all) made.assembly = as_drawn(drawn, *sheet, why, of_assembly);
    if (!made.assembly) {
        Teller teller(tracing, sheet->graph, diagnostics);
        teller.tell_rest(sheet->features, sheet->left);
        teller.tell_elements(sheet->features, sheet->left, why);
        Design design = make_design(tracing, sheet->graph, sheet->page, sheet->features, sheet->left.holes,
                                    drawn.lines.printed, drawn.moves, diagnostics);
        design.file = source.name;
        design.stem = source.stem();
        if (!diagnostics.has_errors_as_given())
            made.design = std::move(design);
        else if (!whole && tried == Tried::all)
            made.assembly = as_drawn(drawn, *sheet, why, of_assembly);
    }
    if (made.assembly) diagnostics = std::move(of_assembly);
    return made;
}

}  // namespace

CardReading read(const Tracing& tracing, const Source& source, Diagnostics& diagnostics) {
    return read(tracing, source, Tried::all, diagnostics);
}

void tell_card(const Tracing& tracing, const Source& source, Diagnostics& diagnostics) {
    Diagnostics unheard(source.name);
    const std::optional<Design> design = read(tracing, source, Tried::elements, unheard).design;
    if (!design || design->structures.empty() || unheard.has_findings()) return;
    const std::size_t count = design->structures.size();
    diagnostics
        .remark(
            "may-be-card", {},
            fmt::format("this is read as a folded sheet; it may be meant as a pop-up card with {} element{}",
                        count, count == 1 ? "" : "s"))
        .hint(
            "--as card reads it as a card, and opens and closes it; --as folded says that it is a folded "
            "sheet");
}

}  // namespace popup::drawing::card
