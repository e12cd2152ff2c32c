#include "pattern/chain.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <set>
#include <tuple>
#include <unordered_map>

#include "base/geometry/cells.h"
#include "base/geometry/edge_index.h"

namespace popup {
namespace {

Box box_around(const Segment& s) {
    Box box;
    box.extend(s.a);
    box.extend(s.b);
    box.min = box.min - Vec2{kSameLineMm, kSameLineMm};
    box.max = box.max + Vec2{kSameLineMm, kSameLineMm};
    return box;
}

// Where a segment lies along another one it is in line with.
struct Span {
    double from, to;  // mm from the other's start, from < to
    Vec2 at_from, at_to;
};

bool in_line(const Segment& line, const Segment& other, Span& span) {
    const Vec2 along = unit(line.b - line.a);
    if (std::abs(cross(along, other.a - line.a)) > kSameLineMm ||
        std::abs(cross(along, other.b - line.a)) > kSameLineMm) {
        return false;
    }
    span = {dot(along, other.a - line.a), dot(along, other.b - line.a), other.a, other.b};
    if (span.from > span.to) span = {span.to, span.from, span.at_to, span.at_from};
    return true;
}

std::vector<Segment> segments_of(const std::vector<TaggedSegment>& tagged) {
    std::vector<Segment> segments;
    segments.reserve(tagged.size());
    for (const TaggedSegment& one : tagged) segments.push_back(one.at);
    return segments;
}

void drop_short(std::vector<TaggedSegment>& segments) {
    std::erase_if(segments, [](const TaggedSegment& s) { return distance(s.at.a, s.at.b) <= kSameLineMm; });
}

}  // namespace

std::vector<TaggedSegment> merged(std::vector<TaggedSegment> segments) {
    drop_short(segments);
    // The longest first: its direction is known best. Each segment is swallowed once, so the work stays
    // linear.
    std::vector<int> order(segments.size());
    std::iota(order.begin(), order.end(), 0);
    const auto size = [&](int i) {
        const Segment& s = segments[static_cast<std::size_t>(i)].at;
        return distance(s.a, s.b);
    };
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return size(a) > size(b); });
    EdgeIndex index(segments_of(segments));
    std::vector<char> alive(segments.size(), 1);
    std::vector<int> found;
    for (const int i : order) {
        const auto me = static_cast<std::size_t>(i);
        if (alive[me] == 0) continue;
        TaggedSegment& mine = segments[me];
        index.remove(i);
        for (bool grown = true; grown;) {
            grown = false;
            index.query(box_around(mine.at), found);
            for (const int j : found) {
                const auto other = static_cast<std::size_t>(j);
                Span span{};
                if (!in_line(mine.at, segments[other].at, span)) continue;
                const double mine_to = distance(mine.at.a, mine.at.b);
                const double gap = std::max(span.from - mine_to, -span.to);
                if (gap > kSameLineMm || (gap >= -kSameLineMm && segments[other].tag != mine.tag)) continue;
                if (span.from < -kSameLineMm) mine.at.a = span.at_from;
                if (span.to > mine_to + kSameLineMm) mine.at.b = span.at_to;
                index.remove(j);
                alive[other] = 0;
                grown = true;
            }
        }
    }
    std::vector<TaggedSegment> result;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        if (alive[i] != 0) result.push_back(segments[i]);
    }
    return result;
}

std::vector<TaggedSegment> without(std::vector<TaggedSegment> segments, std::span<const Segment> taken) {
    drop_short(segments);
    if (taken.empty()) return segments;
    EdgeIndex index(segments_of(segments));
    std::vector<char> alive(segments.size(), 1);
    std::vector<int> found;
    const auto keep = [&](Vec2 a, Vec2 b, int tag) {
        if (distance(a, b) <= kSameLineMm) return;
        segments.push_back({{a, b}, tag});
        alive.push_back(1);
        index.insert({a, b}, false);
    };
    for (const Segment& hole : taken) {
        if (distance(hole.a, hole.b) <= kSameLineMm) continue;
        index.query(box_around(hole), found);
        for (const int i : found) {
            const auto number = static_cast<std::size_t>(i);
            const TaggedSegment old = segments[number];
            Span span{};  // of the hole along the segment
            if (!in_line(old.at, hole, span)) continue;
            if (std::min(span.to, distance(old.at.a, old.at.b)) - std::max(span.from, 0.0) <= kSameLineMm)
                continue;
            index.remove(i);
            alive[number] = 0;
            if (span.from > kSameLineMm) keep(old.at.a, span.at_from, old.tag);
            if (span.to < distance(old.at.a, old.at.b) - kSameLineMm) keep(span.at_to, old.at.b, old.tag);
        }
    }
    std::vector<TaggedSegment> result;
    for (std::size_t i = 0; i < segments.size(); ++i) {
        if (alive[i] != 0) result.push_back(segments[i]);
    }
    return result;
}

namespace {

// Numbers points so that those within kSameLineMm get the same number (a little further, in the same cell).
class Nodes {
 public:
    explicit Nodes(std::size_t expected) { cells_.reserve(expected); }

    int number(Vec2 p) {
        const PlaneCell home = cell(p);
        for (std::int64_t dx = -1; dx <= 1; ++dx) {
            for (std::int64_t dy = -1; dy <= 1; ++dy) {
                const auto it = cells_.find({home.x + dx, home.y + dy});
                if (it == cells_.end()) continue;
                const bool same_cell = dx == 0 && dy == 0;
                if (same_cell || distance(points[static_cast<std::size_t>(it->second)], p) <= kSameLineMm) {
                    return it->second;
                }
            }
        }
        cells_.emplace(home, static_cast<int>(points.size()));
        points.push_back(p);
        return static_cast<int>(points.size()) - 1;
    }

    std::vector<Vec2> points;

 private:
    static PlaneCell cell(Vec2 p) {
        return {std::llround(p.x / kSameLineMm), std::llround(p.y / kSameLineMm)};
    }

    std::unordered_map<PlaneCell, int, PlaneCellHash> cells_;
};

// Segment i leaves its start as end 2i and its end as end 2i + 1.
struct Graph {
    std::vector<Vec2> points;
    std::vector<int> node_of;  // of each end
    std::vector<int> partner;  // the end a path goes on with, or -1 where it stops
};

// Joins the ends that meet in one node two and two.
void pair_ends(std::vector<int>& ends, Graph& graph) {
    const auto direction = [&](int end) {
        const Vec2 here =
            graph.points[static_cast<std::size_t>(graph.node_of[static_cast<std::size_t>(end)])];
        const Vec2 there =
            graph.points[static_cast<std::size_t>(graph.node_of[static_cast<std::size_t>(end ^ 1)])];
        return unit(there - here);
    };
    const auto join = [&](int a, int b) {
        graph.partner[static_cast<std::size_t>(a)] = b;
        graph.partner[static_cast<std::size_t>(b)] = a;
    };
    // A star of very many ends has no straightest pair worth looking for.
    constexpr std::size_t kMany = 16;
    if (ends.size() == 2 || ends.size() > kMany) {
        for (std::size_t i = 0; i + 1 < ends.size(); i += 2) join(ends[i], ends[i + 1]);
        return;
    }
    std::vector<std::tuple<double, int, int>> pairs;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        for (std::size_t j = i + 1; j < ends.size(); ++j) {
            pairs.emplace_back(std::round(1e9 * dot(direction(ends[i]), direction(ends[j]))), ends[i],
                               ends[j]);
        }
    }
    std::sort(pairs.begin(), pairs.end());
    for (const auto& [bend, a, b] : pairs) {
        if (graph.partner[static_cast<std::size_t>(a)] < 0 && graph.partner[static_cast<std::size_t>(b)] < 0)
            join(a, b);
    }
}

Graph connect(const std::vector<TaggedSegment>& segments) {
    Graph graph;
    Nodes nodes(2 * segments.size());
    for (const TaggedSegment& s : segments) {
        graph.node_of.push_back(nodes.number(s.at.a));
        graph.node_of.push_back(nodes.number(s.at.b));
    }
    graph.points = std::move(nodes.points);
    graph.partner.assign(graph.node_of.size(), -1);
    std::vector<std::vector<int>> ends_at(graph.points.size());
    for (std::size_t end = 0; end < graph.node_of.size(); ++end) {
        if (graph.node_of[end] == graph.node_of[end ^ 1U]) continue;  // shorter than the tolerance
        ends_at[static_cast<std::size_t>(graph.node_of[end])].push_back(static_cast<int>(end));
    }
    for (std::vector<int>& ends : ends_at) {
        if (ends.size() >= 2) pair_ends(ends, graph);
    }
    return graph;
}

// Takes the loops out of a walk; what remains of an open walk is a path of its own.
void split_loops(const std::vector<int>& walk, const std::vector<Vec2>& points, std::vector<int>& place,
                 std::vector<Contour>& contours) {
    std::vector<int> stack;
    for (const int node : walk) {
        const int seen = place[static_cast<std::size_t>(node)];
        if (seen < 0) {
            place[static_cast<std::size_t>(node)] = static_cast<int>(stack.size());
            stack.push_back(node);
            continue;
        }
        Contour loop;
        loop.closed = true;
        for (std::size_t i = static_cast<std::size_t>(seen); i < stack.size(); ++i) {
            loop.points.push_back(points[static_cast<std::size_t>(stack[i])]);
            if (i > static_cast<std::size_t>(seen)) place[static_cast<std::size_t>(stack[i])] = -1;
        }
        stack.resize(static_cast<std::size_t>(seen) + 1);
        if (loop.points.size() < 3) loop.closed = false;  // there and back within the tolerance
        contours.push_back(std::move(loop));
    }
    for (const int node : stack) place[static_cast<std::size_t>(node)] = -1;
    if (stack.size() < 2) return;
    Contour path;
    for (const int node : stack) path.points.push_back(points[static_cast<std::size_t>(node)]);
    contours.push_back(std::move(path));
}

bool before(Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; }

}  // namespace

void put_in_order(std::vector<Contour>& contours) {
    std::vector<Segment> edges;
    for (Contour& c : contours) {
        if (!c.closed) {
            if (before(c.points.back(), c.points.front())) std::reverse(c.points.begin(), c.points.end());
            continue;
        }
        if (signed_area(c.points) < 0.0) std::reverse(c.points.begin(), c.points.end());
        std::rotate(c.points.begin(), std::min_element(c.points.begin(), c.points.end(), before),
                    c.points.end());
        const auto own = edges_of({c.points, {}});
        edges.insert(edges.end(), own.begin(), own.end());
    }
    // All closed contours run counter-clockwise, so the winding about a point is the number of contours
    // around it.
    const EdgeIndex index(std::move(edges));
    struct Ranked {
        int depth;
        Vec2 start;
        std::size_t number;
    };
    std::vector<Ranked> ranked;
    for (std::size_t i = 0; i < contours.size(); ++i) {
        const std::vector<Vec2>& points = contours[i].points;
        const Vec2 probe =
            contours[i].closed ? points[0] - Vec2{kSameLineMm, 0.0} : lerp(points[0], points[1], 0.5);
        const int depth = index.winding(probe);
        contours[i].depth = depth;
        ranked.push_back({depth, points[0], i});
        if (contours[i].closed && depth % 2 == 1) {
            std::reverse(contours[i].points.begin() + 1, contours[i].points.end());
        }
    }
    std::sort(ranked.begin(), ranked.end(), [](const Ranked& a, const Ranked& b) {
        return std::tuple(-a.depth, a.start.y, a.start.x, a.number) <
               std::tuple(-b.depth, b.start.y, b.start.x, b.number);
    });
    std::vector<Contour> sorted;
    sorted.reserve(contours.size());
    for (const Ranked& r : ranked) sorted.push_back(std::move(contours[r.number]));
    contours = std::move(sorted);
}

std::vector<Contour> chained(const std::vector<TaggedSegment>& segments) {
    const Graph graph = connect(segments);
    const std::size_t ends = graph.node_of.size();
    std::vector<char> used(segments.size(), 0);
    std::vector<int> place(graph.points.size(), -1);
    std::vector<Contour> contours;
    std::vector<int> walk;
    const auto follow = [&](std::size_t end) {
        walk.assign(1, graph.node_of[end]);
        while (used[end / 2] == 0) {
            used[end / 2] = 1;
            const std::size_t far = end ^ 1U;
            walk.push_back(graph.node_of[far]);
            if (graph.partner[far] < 0) break;
            end = static_cast<std::size_t>(graph.partner[far]);
        }
        split_loops(walk, graph.points, place, contours);
    };
    const auto waiting = [&](std::size_t end) {
        return used[end / 2] == 0 && graph.node_of[end] != graph.node_of[end ^ 1U];
    };
    for (std::size_t end = 0; end < ends; ++end) {
        if (waiting(end) && graph.partner[end] < 0) follow(end);
    }
    for (std::size_t end = 0; end < ends; ++end) {
        if (waiting(end)) follow(end);
    }
    put_in_order(contours);
    return contours;
}

namespace {

// On each joined segment the places where two of the first ones were joined, and a third one ends that goes
// another way: how far along it, and where. Sorted.
std::vector<std::vector<std::pair<double, Vec2>>> corners_on(const std::vector<TaggedSegment>& joined,
                                                             const std::vector<TaggedSegment>& first) {
    struct End {
        double along;
        Vec2 at;
        bool in_line;
    };
    std::vector<std::vector<End>> ends(joined.size());
    const EdgeIndex index(segments_of(joined));
    std::vector<int> found;
    for (const TaggedSegment& one : first) {
        for (const Vec2 p : {one.at.a, one.at.b}) {
            index.query(box_around({p, p}), found);
            for (const int i : found) {
                const Segment& line = joined[static_cast<std::size_t>(i)].at;
                const double along = dot(unit(line.b - line.a), p - line.a);
                if (along <= 2.0 * kSameLineMm || along >= distance(line.a, line.b) - 2.0 * kSameLineMm ||
                    distance(p, line) > kSameLineMm)
                    continue;
                Span span{};
                ends[static_cast<std::size_t>(i)].push_back({along, p, in_line(line, one.at, span)});
            }
        }
    }
    std::vector<std::vector<std::pair<double, Vec2>>> corners(joined.size());
    for (std::size_t i = 0; i < joined.size(); ++i) {
        std::vector<End>& on = ends[i];
        std::sort(on.begin(), on.end(), [](const End& a, const End& b) { return a.along < b.along; });
        for (std::size_t from = 0, to = 0; from < on.size(); from = to) {
            bool own = false;
            bool other = false;
            for (; to < on.size() && on[to].along - on[from].along <= 2.0 * kSameLineMm; ++to)
                (on[to].in_line ? own : other) = true;
            if (own && other) corners[i].emplace_back(on[from].along, on[from].at);
        }
    }
    return corners;
}

// Without the corners in a straight line that are among these.
void drop_straight(Contour& contour, const std::set<std::pair<double, double>>& among) {
    const std::vector<Vec2> points = std::move(contour.points);
    const std::size_t n = points.size();
    contour.points.clear();
    for (std::size_t i = 0; i < n; ++i) {
        const bool end = !contour.closed && (i == 0 || i + 1 == n);
        const Vec2 before = points[(i + n - 1) % n];
        const Vec2 after = points[(i + 1) % n];
        const bool straight = !end && among.contains({points[i].x, points[i].y}) &&
                              distance(points[i], Segment{before, after}) <= kSameLineMm;
        if (!straight) contour.points.push_back(points[i]);
    }
}

}  // namespace

std::vector<Contour> cut_paths(const std::vector<TaggedSegment>& cuts) {
    std::vector<TaggedSegment> joined = merged(cuts);
    const auto corners = corners_on(joined, cuts);
    if (std::all_of(corners.begin(), corners.end(), [](const auto& on) { return on.empty(); }))
        return chained(joined);
    std::vector<TaggedSegment> parts;
    std::set<std::pair<double, double>> parted;
    for (std::size_t i = 0; i < joined.size(); ++i) {
        TaggedSegment rest = joined[i];
        for (const auto& [along, at] : corners[i]) {
            parts.push_back({{rest.at.a, at}, rest.tag});
            rest.at.a = at;
            parted.insert({at.x, at.y});
        }
        parts.push_back(rest);
    }
    std::vector<Contour> contours = chained(parts);
    for (Contour& contour : contours) drop_straight(contour, parted);
    return contours;
}

}  // namespace popup
