#include "folded/in_holes.h"

#include <cstddef>
#include <set>

#include "base/nth.h"

namespace popup::folded {

void tell_cuts_in_holes(const SheetGraph& graph, const std::vector<int>& levels, const CreasePattern& pattern,
                        Diagnostics& diagnostics) {
    std::set<int> told;
    for (std::size_t i = 0; i < graph.edges.size(); ++i) {
        const int half = static_cast<int>(2 * i);
        const GraphEdge& edge = graph.edges[i];
        if (is_fold(edge) || nth(levels, graph.face_of(half)) < 2 || nth(levels, graph.face_of(half ^ 1)) < 2)
            continue;
        if (!told.insert(edge.element).second) continue;
        diagnostics
            .warning("falls-out", nth(pattern.lines, edge.element).place,
                     "this lies in a hole and falls out with it, at " +
                         shown_point(pattern.ruler, graph.at(edge.a)) + "; it is not cut")
            .hint("join it to the paper around, or take it out");
    }
}

void tell_part_in_hole(const SheetGraph& graph, int face, const CreasePattern& pattern,
                       Diagnostics& diagnostics) {
    const int half = graph.halves_of(face).front();
    diagnostics
        .warning("falls-out", nth(pattern.lines, graph.edge(half).element).place,
                 "this part lies in a hole of another and falls out with it, at " +
                     shown_point(pattern.ruler, graph.at(graph.from(half))) + "; it is not folded")
        .hint("join it to the paper around it with a fold, or take its folds out");
}

}  // namespace popup::folded
