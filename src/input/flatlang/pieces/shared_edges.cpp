#include "input/flatlang/pieces/shared_edges.h"

#include <algorithm>
#include <array>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>

#include "base/sets.h"

namespace popup::flatlang {
namespace {

namespace bg = boost::geometry;
using TreePoint = bg::model::point<double, 3, bg::cs::cartesian>;
using TreeBox = bg::model::box<TreePoint>;
using Entry = std::pair<TreeBox, int>;

std::size_t at(int number) { return static_cast<std::size_t>(number); }

// One line of space, and whose edges it is.
struct Line {
    Vec3 from, to;
    std::vector<std::pair<int, bool>> users;  // face; whether its edge runs this way
};

TreeBox box_of(const Line& line, double margin) {
    return {{std::min(line.from.x, line.to.x) - margin, std::min(line.from.y, line.to.y) - margin,
             std::min(line.from.z, line.to.z) - margin},
            {std::max(line.from.x, line.to.x) + margin, std::max(line.from.y, line.to.y) + margin,
             std::max(line.from.z, line.to.z) + margin}};
}

// Most edges that are shared are so from end to end.
std::vector<Line> lines_of(std::span<const FaceEdge> edges) {
    constexpr double kCell = 1e-3;
    using Key = std::array<std::int64_t, 3>;
    const auto key_of = [](Vec3 p) {
        return Key{std::llround(p.x / kCell), std::llround(p.y / kCell), std::llround(p.z / kCell)};
    };
    std::map<std::pair<Key, Key>, std::size_t> known;
    std::vector<Line> lines;
    for (const FaceEdge& edge : edges) {
        if (distance(edge.from, edge.to) < kMeetMm) continue;
        Key a = key_of(edge.from);
        Key b = key_of(edge.to);
        const bool forward = a < b;
        if (!forward) std::swap(a, b);
        const auto [place, fresh] = known.try_emplace({a, b}, lines.size());
        if (fresh) lines.push_back({forward ? edge.from : edge.to, forward ? edge.to : edge.from, {}});
        lines[place->second].users.emplace_back(edge.face, forward);
    }
    return lines;
}

// True when the two run along each other for some way.
bool overlap(const Line& a, const Line& b) {
    const bool a_longer = distance(a.from, a.to) >= distance(b.from, b.to);
    const Line& large = a_longer ? a : b;
    const Line& small = a_longer ? b : a;
    const Vec3 along = unit(large.to - large.from);
    for (const Vec3 p : {small.from, small.to}) {
        if (length(cross(along, p - large.from)) > kMeetMm) return false;
    }
    const double s = dot(along, small.from - large.from);
    const double t = dot(along, small.to - large.from);
    return std::min(std::max(s, t), distance(large.from, large.to)) - std::max(std::min(s, t), 0.0) > kMeetMm;
}

// What stands on one line: the stretches of it that exactly two faces have.
void sweep(const std::vector<const Line*>& lines, std::vector<SharedStretch>& found) {
    const Line& longest = **std::max_element(lines.begin(), lines.end(), [](const Line* a, const Line* b) {
        return distance(a->from, a->to) < distance(b->from, b->to);
    });
    const Vec3 origin = longest.from;
    const Vec3 along = unit(longest.to - longest.from);
    struct Event {
        double t;
        int face;
        int step;  // +1 begins, -1 ends
        bool forward;
    };
    std::vector<Event> events;
    for (const Line* line : lines) {
        const double s = dot(along, line->from - origin);
        const double t = dot(along, line->to - origin);
        for (const auto& [face, forward] : line->users) {
            events.push_back({std::min(s, t), face, 1, forward == (s < t)});
            events.push_back({std::max(s, t), face, -1, forward == (s < t)});
        }
    }
    std::sort(events.begin(), events.end(), [](const Event& a, const Event& b) {
        return std::tie(a.t, a.step, a.face, a.forward) < std::tie(b.t, b.step, b.face, b.forward);
    });
    struct Stretch {
        double from, to;
        std::pair<int, bool> a, b;
    };
    std::vector<Stretch> stretches;
    std::map<std::pair<int, bool>, int> active;
    for (std::size_t i = 0; i < events.size(); ++i) {
        const Event& event = events[i];
        int& count = active[{event.face, event.forward}];
        count += event.step;
        if (count <= 0) active.erase({event.face, event.forward});
        if (active.size() != 2 || i + 1 == events.size() || !(events[i + 1].t > event.t)) continue;
        const Stretch next{event.t, events[i + 1].t, active.begin()->first, std::next(active.begin())->first};
        if (next.a.first == next.b.first) continue;
        // Rounding makes gaps that are none, with a little of other pairs in between.
        constexpr std::ptrdiff_t kLast = 4;
        const auto oldest = stretches.rbegin() + std::min(kLast, std::ssize(stretches));
        const auto before = std::find_if(stretches.rbegin(), oldest, [&](const Stretch& one) {
            return one.a == next.a && one.b == next.b;
        });
        if (before != oldest && next.from - before->to <= kMeetMm) {
            before->to = next.to;
        } else {
            stretches.push_back(next);
        }
    }
    for (const Stretch& one : stretches) {
        if (one.to - one.from < kShortestMm) continue;
        found.push_back({one.a.first, one.b.first, origin + one.from * along, origin + one.to * along,
                         one.a.second, one.b.second});
    }
}

}  // namespace

std::optional<std::vector<SharedStretch>> find_shared(std::span<const FaceEdge> edges, Work& work) {
    const std::vector<Line> lines = lines_of(edges);
    std::vector<Entry> entries;
    entries.reserve(lines.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
        entries.emplace_back(box_of(lines[i], 0.0), static_cast<int>(i));
    }
    const bg::index::rtree<Entry, bg::index::quadratic<16>> tree(entries);
    Sets groups(lines.size());
    std::vector<Entry> near;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        near.clear();
        tree.query(bg::index::intersects(box_of(lines[i], kMeetMm)), std::back_inserter(near));
        constexpr std::size_t kLooks = 10;
        if (!work.looks(kLooks * near.size())) return std::nullopt;
        for (const Entry& other : near) {
            if (at(other.second) > i && overlap(lines[i], lines[at(other.second)])) {
                groups.unite(static_cast<int>(i), other.second);
            }
        }
    }
    std::vector<std::vector<const Line*>> members(lines.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
        members[at(groups.find(static_cast<int>(i)))].push_back(&lines[i]);
    }
    std::vector<SharedStretch> found;
    for (const std::vector<const Line*>& group : members) {
        if (!group.empty() && (group.size() > 1 || group.front()->users.size() > 1)) sweep(group, found);
    }
    std::stable_sort(found.begin(), found.end(), [](const SharedStretch& p, const SharedStretch& q) {
        return std::pair(p.a, p.b) < std::pair(q.a, q.b);
    });
    return found;
}

}  // namespace popup::flatlang
