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

    // What elements are not found of, and what they change.
    void tell_elements(const Features& features, const Leftovers& left) {
        for (const std::vector<NotUnderstood>* faults : {&features.faults, &left.faults}) {
            for (const NotUnderstood& one : *faults) {
                Diagnostic& told = diagnostics_.error("not-understood", place(one), one.what + at(one));
                if (!one.hint.empty()) told.hint(one.hint);
                told.hint(
                    "mend the drawing there; what is no part of the card is left out with --lines "
                    "ignore=NAME, of a layer, class, id or colour");
            }
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

}  // namespace

namespace {

enum class Tried { elements, all };

// A card of no elements, and what is said of it.
std::optional<OrigamicCard> read_origamic(const Tracing& tracing, const SheetGraph& graph,
                                          const CardPage& page, const Features& features,
                                          const Leftovers& left, const CardLines& drawn,
                                          const std::vector<Segment>& moves, Diagnostics& diagnostics) {
    auto card = origamic_card(tracing, graph, page, features, drawn.printed, moves);
    if (!card) return std::nullopt;
    Teller teller(tracing, graph, diagnostics);
    teller.tell_rest(features, left);
    teller.tell_origamic(*card);
    return card;
}

// The same where folds are drawn on through plates, without these stretches.
std::optional<OrigamicCard> read_without(const std::vector<int>& stretches, const Tracing& tracing,
                                         const SheetGraph& graph, const CardLines& drawn,
                                         const std::vector<Segment>& moves, Diagnostics& diagnostics) {
    if (stretches.empty()) return std::nullopt;
    Diagnostics unheard(diagnostics.file());
    const auto rest = make_graph(without(drawn.lines, graph, stretches));
    const auto page = rest ? find_page(tracing, *rest, unheard) : std::nullopt;
    if (!page) return std::nullopt;
    const Features features = find_features(*rest, *page);
    const Leftovers left = find_leftovers(*rest, features);
    auto card = read_origamic(tracing, *rest, *page, features, left, drawn, moves, diagnostics);
    if (!card) return std::nullopt;
    std::set<int> told;  // lines
    for (const int stretch : stretches) {
        const GraphEdge& edge = nth(graph.edges, stretch);
        if (!told.insert(edge.line).second) continue;
        Teller(tracing, graph, diagnostics)
            .tell_drawn_on({edge.element, {}, graph.at(edge.a)}, "the paper beyond a cut",
                           "end the fold at the cut");
    }
    return card;
}

CardReading read(const Tracing& tracing, const Source& source, Tried tried, Diagnostics& diagnostics) {
    CardReading made;
    CardLines drawn = card_lines(tracing, diagnostics);
    std::vector<Segment> moves;
    const auto graph = join_ends(tracing, drawn.lines, moves, diagnostics);
    if (!graph) return made;
    const auto page = find_page(tracing, *graph, diagnostics);
    if (!page) return made;
    const Features features = find_features(*graph, *page);
    const Leftovers left = find_leftovers(*graph, features);
    Diagnostics of_card = diagnostics;
    Teller(tracing, *graph, diagnostics).tell_rest(features, left);
    Teller(tracing, *graph, diagnostics).tell_elements(features, left);
    Design design =
        make_design(tracing, *graph, *page, features, left.holes, drawn.printed, moves, diagnostics);
    if (!diagnostics.has_errors_as_given()) {
        design.file = source.name;
        design.stem = source.stem();
        made.design = std::move(design);
        return made;
    }
    if (tried == Tried::elements) return made;
    auto card = read_origamic(tracing, *graph, *page, features, left, drawn, moves, of_card);
    if (!card) {
        card = read_without(folds_drawn_on(*graph, *page, features), tracing, *graph, drawn, moves, of_card);
    }
    if (!card) return made;
    diagnostics = std::move(of_card);
    made.assembly = std::move(card->assembly);
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
