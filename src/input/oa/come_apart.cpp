#include "input/oa/come_apart.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <utility>

#include "base/geometry/edge_index.h"
#include "base/geometry/tolerances.h"
#include "base/nth.h"

namespace popup::oa {
namespace {

// The edges of a region, paper on the left of each, parted where a corner of it lies on them; nothing where
// no corner touches another edge, and none is passed twice.
std::vector<Segment> edges_where_it_touches(const Polygon& region) {
    std::vector<Segment> edges = edges_of(region);
    const EdgeIndex index({}, edges);
    std::vector<int> found;
    std::vector<std::pair<int, Vec2>> touched;  // edges, and the corners on them
    bool twice = false;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const Vec2 p = edges[i].a;
        const Vec2 reach{kOnGridLineMm, kOnGridLineMm};
        index.query({p - reach, p + reach}, found);
        for (const int number : found) {
            const Segment& edge = index[number];
            if (edge.a == p) twice = twice || static_cast<std::size_t>(number) != i;
            if (edge.a == p || edge.b == p || distance(p, edge) > kOnGridLineMm) continue;
            touched.emplace_back(number, p);
        }
    }
    if (touched.empty()) return twice ? edges : std::vector<Segment>{};
    std::sort(touched.begin(), touched.end(), [&](const auto& one, const auto& other) {
        if (one.first != other.first) return one.first < other.first;
        const Vec2 from = index[one.first].a;
        return distance(from, one.second) < distance(from, other.second);
    });
    for (std::size_t i = touched.size(); i-- > 0;) {
        const auto [number, at] = touched[i];
        const Vec2 end = nth(edges, number).b;
        if (end == at) continue;
        nth(edges, number).b = at;
        edges.push_back({at, end});
    }
    return edges;
}

// Rings of the edges. Where several begin in a point the one is next that follows on the border of the same
// paper.
std::vector<Ring> rings_of(const std::vector<Segment>& edges) {
    const auto key = [](Vec2 p) { return std::pair(p.x, p.y); };
    std::map<std::pair<double, double>, std::vector<std::size_t>> from;
    for (std::size_t i = 0; i < edges.size(); ++i) from[key(edges[i].a)].push_back(i);
    // How far to turn from the edge's way back to the next one, clockwise.
    const auto turn = [&](const Segment& edge, const Segment& next) {
        const Vec2 back = edge.a - edge.b;
        const Vec2 on = next.b - next.a;
        const double angle = std::atan2(cross(on, back), dot(on, back));
        return angle > 0.0 ? angle : angle + 2.0 * std::numbers::pi;
    };
    std::vector<char> passed(edges.size(), 0);
    std::vector<Ring> rings;
    for (std::size_t first = 0; first < edges.size(); ++first) {
        Ring ring;
        for (std::size_t i = first; passed[i] == 0;) {
            passed[i] = 1;
            ring.push_back(edges[i].a);
            const std::vector<std::size_t>& next = from[key(edges[i].b)];
            if (next.empty()) break;
            i = *std::min_element(next.begin(), next.end(), [&](std::size_t a, std::size_t b) {
                return turn(edges[i], edges[a]) < turn(edges[i], edges[b]);
            });
        }
        if (!ring.empty()) rings.push_back(std::move(ring));
    }
    return rings;
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

}  // namespace

std::vector<Polygon> come_apart(std::vector<Polygon> regions) {
    std::vector<Polygon> result;
    for (Polygon& region : regions) {
        const std::vector<Segment> edges = edges_where_it_touches(region);
        if (edges.empty()) {
            result.push_back(std::move(region));
            continue;
        }
        std::vector<Polygon> parts;
        std::vector<Ring> holes;
        const auto sort_out = [&](Ring loop) {
            if (signed_area(loop) > 0.0) {
                parts.push_back({std::move(loop), {}});
            } else {
                holes.push_back(std::move(loop));
            }
        };
        for (const Ring& ring : rings_of(edges)) {
            for (Ring& loop : loops_of(ring)) sort_out(std::move(loop));
        }
        // A hole lies in the smallest part that holds a point of its inside.
        for (Ring& hole : holes) {
            Ring turned(hole.rbegin(), hole.rend());
            const Vec2 inside = inner_point({std::move(turned), {}}, 1e-3).at;
            Polygon* best = nullptr;
            for (Polygon& part : parts) {
                if (!contains({part.outer, {}}, inside)) continue;
                if (best == nullptr || signed_area(part.outer) < signed_area(best->outer)) best = &part;
            }
            if (best != nullptr) best->holes.push_back(std::move(hole));
        }
        for (Polygon& part : parts) result.push_back(std::move(part));
    }
    return result;
}

}  // namespace popup::oa
