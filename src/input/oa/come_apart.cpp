#include "input/oa/come_apart.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/geometry/edge_index.h"
#include "base/geometry/sheet_graph.h"
#include "base/geometry/tolerances.h"

namespace popup::oa {
namespace {

// Corners and edges no further apart than this touch.
constexpr double kTouching = kOnGridLineMm;
// What rounding may make of an area, in mm².
constexpr double kSpeck = 1e-3;
// How near to the best place for a point inside of a part it is looked for.
constexpr double kPointInsideMm = 1e-3;

// Whether a corner touches an edge that does not begin or end there, or another corner.
bool touches_itself(const std::vector<Segment>& edges) {
    const EdgeIndex index({}, edges);
    const Vec2 reach{kTouching, kTouching};
    std::vector<int> found;
    return std::any_of(edges.begin(), edges.end(), [&](const Segment& corner) {
        const Vec2 p = corner.a;
        index.query({p - reach, p + reach}, found);
        std::size_t own = 0;
        return std::any_of(found.begin(), found.end(), [&](int number) {
            const Segment& edge = index[number];
            if ((edge.a == p || edge.b == p) && ++own <= 2) return false;
            return distance(p, edge) <= kTouching;
        });
    });
}

// The loops of a ring, each of which passes no corner twice.
std::vector<Ring> loops_of(const Ring& ring) {
    std::vector<Ring> loops;
    Ring open;                                            // what has been passed and is in no loop yet
    std::map<std::pair<double, double>, std::size_t> at;  // where a corner stands in it
    for (const Vec2 p : ring) {
        const auto [found, fresh] = at.try_emplace({p.x, p.y}, open.size());
        if (!fresh) {
            const std::size_t from = found->second;
            loops.emplace_back(open.begin() + static_cast<std::ptrdiff_t>(from), open.end());
            for (std::size_t i = from + 1; i < open.size(); ++i) at.erase({open[i].x, open[i].y});
            open.resize(from);
        }
        open.push_back(p);
    }
    loops.push_back(std::move(open));
    std::erase_if(loops, [](const Ring& loop) { return loop.size() < 3 || signed_area(loop) == 0.0; });
    return loops;
}

// A face of the graph; nullopt where rounding has left no one ring around it.
std::optional<Polygon> shape_of(const SheetGraph& graph, int face) {
    std::set<int> passed;
    std::vector<Ring> rings;
    for (const int first : graph.halves_of(face)) {
        Ring ring;
        for (int half = first; passed.insert(half).second; half = graph.next(half)) {
            // There and back between two corners is no border.
            if (graph.face_of(half ^ 1) != face) ring.push_back(graph.at(graph.from(half)));
        }
        for (Ring& loop : loops_of(ring)) rings.push_back(std::move(loop));
    }
    const auto outer =
        std::partition(rings.begin(), rings.end(), [](const Ring& ring) { return signed_area(ring) > 0.0; });
    if (outer - rings.begin() != 1) return std::nullopt;
    return Polygon{rings.front(), {rings.begin() + 1, rings.end()}};
}

// The parts of a region that touches itself; nullopt where rounding made more of it than corners that touch.
std::optional<std::vector<Polygon>> parts_of(const Polygon& region) {
    std::vector<SheetLine> lines{{region.outer, true}};
    for (const Ring& hole : region.holes) lines.push_back({hole, true});
    const std::optional<SheetGraph> graph = make_graph(lines, kTouching);
    if (!graph) return std::nullopt;
    std::vector<Polygon> parts;
    for (int face = 1; face < graph->faces(); ++face) {
        std::optional<Polygon> shape = shape_of(*graph, face);
        if (shape && contains(region, inner_point(*shape, kPointInsideMm).at))
            parts.push_back(std::move(*shape));
    }
    if (std::abs(area(parts) - area(region)) > kSpeck) return std::nullopt;
    return parts;
}

}  // namespace

std::vector<Polygon> come_apart(std::vector<Polygon> regions) {
    std::vector<Polygon> result;
    for (Polygon& region : regions) {
        std::optional<std::vector<Polygon>> parts;
        if (touches_itself(edges_of(region))) parts = parts_of(region);
        if (!parts) {
            result.push_back(std::move(region));
            continue;
        }
        result.insert(result.end(), parts->begin(), parts->end());
    }
    return result;
}

}  // namespace popup::oa
