#include "folded/folds_on_cuts.h"

#include <fmt/format.h>

#include <cstddef>
#include <map>
#include <utility>

#include "base/nth.h"

namespace popup::folded {
namespace {

constexpr std::size_t kToldAtMost = 5;

struct OnCut {
    double length = 0.0;
    Vec2 first;
    int element = 0;
};

}  // namespace

void tell_folds_on_cuts(const SheetGraph& graph, const std::vector<int>& panel_of,
                        const std::vector<Panel>& panels, const CreasePattern& pattern,
                        Diagnostics& diagnostics) {
    const auto piece_at = [&](int half) {
        const int panel = nth(panel_of, graph.face_of(half));
        return panel < 0 ? -1 : nth(panels, panel).piece;
    };
    std::map<std::pair<int, int>, OnCut> between;
    for (std::size_t i = 0; i < graph.edges.size(); ++i) {
        const GraphEdge& edge = graph.edges[i];
        if ((edge.ink & kCut) == 0 || !is_fold(edge)) continue;
        std::pair<int, int> pieces{piece_at(static_cast<int>(2 * i)), piece_at(static_cast<int>(2 * i + 1))};
        if (pieces.first > pieces.second) std::swap(pieces.first, pieces.second);
        if (pieces.first < 0 || pieces.first == pieces.second) continue;
        const auto [at, fresh] = between.try_emplace(pieces);
        if (fresh) {
            at->second.first = graph.at(edge.a);
            at->second.element = edge.element;
        }
        at->second.length += distance(graph.at(edge.a), graph.at(edge.b));
    }
    std::size_t told = 0;
    for (const auto& [pieces, one] : between) {
        if (++told > kToldAtMost) return;
        diagnostics
            .warning(
                "fold-on-cut", nth(pattern.lines, one.element).place,
                fmt::format(
                    "a fold and a cut lie on each other, over {:.1f} mm from {}: the sheet is cut there, "
                    "and falls into two pieces",
                    one.length, shown_point(pattern.ruler, one.first)))
            .hint("take the cut out if the sheet is to fold there, or else the fold");
    }
}

}  // namespace popup::folded
