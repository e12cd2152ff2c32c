#include "input/drawing/card/read.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "base/nth.h"
#include "input/drawing/card/features.h"
#include "input/drawing/card/leftovers.h"
#include "input/drawing/card/lines.h"
#include "input/drawing/card/page.h"
#include "input/drawing/card/to_design.h"

namespace popup::drawing::card {
namespace {

// Findings about features, each with its place.
class Teller {
 public:
    Teller(const Tracing& tracing, const SheetGraph& graph, Diagnostics& diagnostics)
        : tracing_(tracing), graph_(graph), diagnostics_(diagnostics) {}

    void tell(const Features& features, const Leftovers& left) {
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
            diagnostics_
                .warning("fold-drawn-on", place(one),
                         "this fold is drawn on through a feature that stands on it, from" +
                             at(one).substr(4) + "; that stretch was left out")
                .hint("end the fold at the cuts of the feature")
                .changed("a fold through the feature", "a fold up to its cuts");
        }
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
        if (!left.outside.empty()) {
            const std::size_t count = left.outside.size();
            diagnostics_
                .warning("outside-page", place(left.outside.front()),
                         fmt::format("{} element{} outside of the page, and {} no part of the card", count,
                                     count == 1 ? " lies" : "s lie", count == 1 ? "is" : "are"))
                .hint("a drawing is one card; its page is what surrounds most");
        }
        tell_ways(left);
    }

 private:
    [[nodiscard]] Place place(const NotUnderstood& one) const {
        return nth(tracing_.elements, one.element).place;
    }
    [[nodiscard]] std::string at(const NotUnderstood& one) const {
        return ", at " + shown_point(tracing_.ruler, one.at);
    }

    void tell_ways(const Leftovers& left) {
        if (left.other_way.empty()) return;
        const GraphEdge& first = nth(graph_.edges, left.other_way.front());
        const Place where = nth(tracing_.elements, first.element).place;
        const std::size_t wrong = left.other_way.size();
        if (left.as_drawn.empty()) {
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
                         wrong, wrong + left.as_drawn.size(), wrong == 1 ? "is" : "are",
                         wrong == 1 ? "it" : "they", shown_point(tracing_.ruler, graph_.at(first.a))))
            .hint(
                "folds that hold a feature go the way of the fold it stands on, its middle fold the other "
                "way");
    }

    const Tracing& tracing_;
    const SheetGraph& graph_;
    Diagnostics& diagnostics_;
};

}  // namespace

std::optional<Design> read(const Tracing& tracing, const Source& source, Diagnostics& diagnostics) {
    CardLines drawn = card_lines(tracing, diagnostics);
    std::vector<Segment> moves;
    const auto graph = join_ends(tracing, drawn.lines, moves, diagnostics);
    if (!graph) return std::nullopt;
    const auto page = find_page(tracing, *graph, diagnostics);
    if (!page) return std::nullopt;
    const Features features = find_features(*graph, *page);
    const Leftovers left = find_leftovers(*graph, features);
    Teller(tracing, *graph, diagnostics).tell(features, left);
    Design design = make_design(tracing, *graph, *page, features, left.holes, drawn.printed, std::move(moves),
                                diagnostics);
    if (diagnostics.has_errors_as_given()) return std::nullopt;
    design.file = source.name;
    design.stem = source.stem();
    return design;
}

void tell_card(const Tracing& tracing, const Source& source, Diagnostics& diagnostics) {
    Diagnostics unheard(source.name);
    const std::optional<Design> design = read(tracing, source, unheard);
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
