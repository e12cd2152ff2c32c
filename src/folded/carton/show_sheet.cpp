#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/nth.h"
#include "folded/carton/vertices.h"
#include "popup/sheet_edit.h"

namespace popup {

using folded::CornerOf;
using folded::Fold;

std::optional<ShownSheet> show_sheet(const CreasePattern& pattern, const FoldOptions& options,
                                     const std::vector<Join>& joins, Diagnostics& diagnostics) {
    const auto shape = folded::vertices_of(pattern, options, joins, diagnostics);
    if (!shape) return std::nullopt;
    std::map<CornerOf, std::string> name_of;
    for (const int panel : shape->tree().order) {
        const std::vector<int>& named = shape->named(panel);
        for (std::size_t i = 0; i < named.size(); ++i)
            name_of[{panel, named[i]}] = fmt::format("{}.{}", shape->name_of(panel), i + 1);
    }
    std::map<std::array<int, 3>, int> other_of;
    for (const Fold& fold : shape->sheet().folds) {
        const int a = shape->vertex_of(fold.stretches.front().a);
        const int b = shape->vertex_of(fold.stretches.back().b);
        if (a < 0 || b < 0) continue;
        other_of[{fold.left, std::min(a, b), std::max(a, b)}] = fold.right;
        other_of[{fold.right, std::min(a, b), std::max(a, b)}] = fold.left;
    }
    ShownSheet shown;
    for (const int panel : shape->tree().order) {
        ShownSheet::Panel& one = shown.panels.emplace_back();
        one.name = shape->name_of(panel);
        one.out = shape->out(panel);
        const std::vector<int>& named = shape->named(panel);
        for (std::size_t i = 0; i < named.size(); ++i) {
            const int corner = named[i];
            const int next = named[(i + 1) % named.size()];
            ShownSheet::Vertex& vertex = one.vertices.emplace_back();
            vertex.name = name_of.at({panel, corner});
            vertex.flat = shape->sheet().at(corner);
            vertex.at = shape->place(corner);
            for (const CornerOf member : nth(shape->members(), shape->vertex_of(corner))) {
                const auto found = name_of.find(member);
                if (member.panel != panel && found != name_of.end()) vertex.meets.push_back(found->second);
            }
            if (named.size() < 2 || (named.size() == 2 && i == 1)) continue;
            ShownSheet::Edge& edge = one.edges.emplace_back();
            edge.name = fmt::format("{}.{}-{}", one.name, i + 1, (i + 1) % named.size() + 1);
            edge.length_mm = distance(shape->sheet().at(corner), shape->sheet().at(next));
            const auto [low, high] = std::minmax({shape->vertex_of(corner), shape->vertex_of(next)});
            const auto found = other_of.find({panel, low, high});
            if (found != other_of.end()) edge.other = shape->name_of(found->second);
        }
    }
    return shown;
}

}  // namespace popup
