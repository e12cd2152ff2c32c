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

// Corners and edges no further apart than this touch.
constexpr double kTouching = kOnGridLineMm;
// What rounding may make of an area, in mm².
constexpr double kSpeck = 1e-3;

using Key = std::pair<double, double>;
Key key(Vec2 p) { return {p.x, p.y}; }

// Calls `look` with the number of each edge that comes near the point, until it returns true. Returns whether
// it did.
template <typename Look>
bool any_edge_near(const EdgeIndex& index, Vec2 p, std::vector<int>& found, const Look& look) {
    const Vec2 reach{kTouching, kTouching};
    index.query({p - reach, p + reach}, found);
    std::sort(found.begin(), found.end());
    return std::any_of(found.begin(), found.end(), look);
}

// Whether a corner touches an edge that does not begin or end there, or another corner.
bool touches_itself(const std::vector<Segment>& edges) {
    const EdgeIndex index({}, edges);
    std::vector<int> found;
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const Vec2 p = edges[i].a;
        std::size_t own = 0;
        const bool any = any_edge_near(index, p, found, [&](int number) {
            const Segment& edge = index[number];
            if ((edge.a == p || edge.b == p) && ++own <= 2) return false;
            return distance(p, edge) <= kTouching;
        });
        if (any) return true;
    }
    return false;
}

// Makes one of corners that touch.
void join_corners(std::vector<Segment>& edges) {
    const EdgeIndex index({}, edges);
    std::map<Key, Vec2> place;
    std::vector<int> found;
    for (const Segment& edge : edges) {
        Vec2 at = edge.a;
        any_edge_near(index, edge.a, found, [&](int number) {
            const auto known = place.find(key(index[number].a));
            if (known == place.end() || distance(known->second, edge.a) > kTouching) return false;
            at = known->second;
            return true;
        });
        place.emplace(key(edge.a), at);
    }
    for (Segment& edge : edges) edge = {place.at(key(edge.a)), place.at(key(edge.b))};
    std::erase_if(edges, [](const Segment& edge) { return edge.a == edge.b; });
}

// Parts edges where a corner touches them.
void part_at_corners(std::vector<Segment>& edges) {
    const EdgeIndex index({}, edges);
    std::vector<int> found;
    std::vector<std::pair<int, Vec2>> touched;  // edges, and the corners on them
    for (const Segment& corner : edges) {
        any_edge_near(index, corner.a, found, [&](int number) {
            const Segment& edge = index[number];
            if (edge.a != corner.a && edge.b != corner.a && distance(corner.a, edge) <= kTouching)
                touched.emplace_back(number, corner.a);
            return false;
        });
    }
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
}

// There and back between two corners is no paper.
void drop_back_and_forth(std::vector<Segment>& edges) {
    std::map<std::pair<Key, Key>, int> back;
    for (const Segment& edge : edges) ++back[{key(edge.b), key(edge.a)}];
    std::erase_if(edges, [&](const Segment& edge) {
        const auto found = back.find({key(edge.a), key(edge.b)});
        return found != back.end() && found->second-- > 0;
    });
}

// Rings of the edges, which have paper on their left. Where several begin in a point the one is next that
// follows on the border of the same paper. Empty where one does not close.
std::vector<Ring> rings_of(const std::vector<Segment>& edges) {
    std::map<Key, std::vector<std::size_t>> from;
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
        if (passed[first] != 0) continue;
        Ring& ring = rings.emplace_back();
        std::size_t i = first;
        do {
            if (passed[i] != 0) return {};
            passed[i] = 1;
            ring.push_back(edges[i].a);
            const std::vector<std::size_t>& next = from[key(edges[i].b)];
            if (next.empty()) return {};
            i = *std::min_element(next.begin(), next.end(), [&](std::size_t a, std::size_t b) {
                return turn(edges[i], edges[a]) < turn(edges[i], edges[b]);
            });
        } while (i != first);
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
        std::vector<Segment> edges = edges_of(region);
        if (!touches_itself(edges)) {
            result.push_back(std::move(region));
            continue;
        }
        join_corners(edges);
        part_at_corners(edges);
        drop_back_and_forth(edges);
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
        // Where rounding made more of it than corners that touch, it stays as it is.
        const double lost = area(std::vector<Polygon>{region}) - area(parts);
        if (std::abs(lost) > kSpeck) {
            result.push_back(std::move(region));
            continue;
        }
        for (Polygon& part : parts) result.push_back(std::move(part));
    }
    return result;
}

}  // namespace popup::oa
