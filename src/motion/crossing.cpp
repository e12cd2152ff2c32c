// Both plates are cut by the line in which their planes meet. What the two cuts have in common is where they
// cross.
#include "motion/crossing.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace popup {
namespace {

constexpr double kParallel = 1e-9;  // sine of the angle between planes that never meet
constexpr double kFar = 20.0;       // how far from an edge is far enough
constexpr int kFew = 48;            // edges that are looked at without asking where they are
// Edges this near to the line run along it.
constexpr double kAlongMm = 1e-6;

using Passage = CrossingTest::Passage;
using Stretch = CrossingTest::Stretch;

// A line on a page.
struct CutLine {
    Vec2 at, along;  // along: unit
    [[nodiscard]] double across(Vec2 p) const { return cross(along, p - at); }
    [[nodiscard]] Vec2 point(double t) const { return at + t * along; }
    // In coordinates in which the line is the x axis.
    [[nodiscard]] Vec2 seen(Vec2 p) const { return {dot(along, p - at), across(p)}; }
};

// Where edges of the outline run along the line: no point there is inside.
void add_runs(const Ring& ring, const CutLine& line, std::vector<Stretch>& runs) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
        if (std::abs(line.across(ring[i])) > kAlongMm || std::abs(line.across(ring[j])) > kAlongMm) continue;
        const auto [from, to] =
            std::minmax({dot(line.along, ring[j] - line.at), dot(line.along, ring[i] - line.at)});
        runs.push_back({from, to});
    }
}

// Passages of one ring, each with the reach of the two stretches of ring that meet in it.
void cut(const Ring& ring, const CutLine& line, std::vector<Passage>& passages) {
    const std::size_t n = ring.size();
    const auto side = [&](std::size_t i) { return line.across(ring[i % n]) >= 0.0; };
    std::size_t start = 0;
    while (start < n && side(start) == side(start + 1)) ++start;
    if (start == n) return;
    const std::size_t first = passages.size();
    double reach = 0.0;
    // Each stretch lies between two passages and counts for both.
    for (std::size_t k = 0; k < n; ++k) {
        const std::size_t i = start + k;
        const double from = line.across(ring[i % n]);
        const double to = line.across(ring[(i + 1) % n]);
        if ((from >= 0.0) != (to >= 0.0)) {
            if (passages.size() > first) {
                (from >= 0.0 ? passages.back().reach_left : passages.back().reach_right) = reach;
            }
            Passage passage;
            const Vec2 p = lerp(ring[i % n], ring[(i + 1) % n], from / (from - to));
            passage.along = dot(line.along, p - line.at);
            (from >= 0.0 ? passage.reach_left : passage.reach_right) = reach;
            passages.push_back(passage);
            reach = std::abs(to);
        } else {
            reach = std::max(reach, std::abs(to));
        }
    }
    // The last stretch leads back to the first passage.
    Passage& last = passages.back();
    Passage& begin = passages[first];
    const bool left = line.across(ring[(start + n) % n]) >= 0.0;
    (left ? last.reach_left : last.reach_right) = reach;
    (left ? begin.reach_left : begin.reach_right) = reach;
}

void cut(const PlateShape& shape, const CutLine& line, std::vector<Passage>& passages) {
    passages.clear();
    for (const Ring& ring : shape.rings) cut(ring, line, passages);
    std::sort(passages.begin(), passages.end(),
              [](const Passage& a, const Passage& b) { return a.along < b.along; });
}

double reach_of(const Passage& from, const Passage& to) {
    return std::min(std::max(from.reach_left, to.reach_left), std::max(from.reach_right, to.reach_right));
}

// Calls back with what of a stretch lies on none of these. False: nothing of it does.
template <typename Function>
bool each_between(const std::vector<Stretch>& runs, double from, double to, const Function& on_part) {
    bool any = false;
    const auto part = [&](double begin, double end) {
        if (!(begin < end)) return;
        any = true;
        on_part(begin, end);
    };
    for (const Stretch& run : runs) {
        if (run.to <= from) continue;
        if (run.from >= to) break;
        part(from, run.from);
        from = run.to;
    }
    part(from, to);
    return any;
}

}  // namespace

double sine_between(const Frame& b_in_a) { return std::hypot(b_in_a.normal().x, b_in_a.normal().y); }

std::optional<Crossing> CrossingTest::operator()(const PlateShape& a, const PlateShape& b,
                                                 const Frame& b_in_a) {
    const Vec3 normal = b_in_a.normal();
    const Vec2 tilt{normal.x, normal.y};
    const double sine = length(tilt);
    if (sine < kParallel) return std::nullopt;
    const Vec2 across = (1.0 / sine) * tilt;
    CutLine on_a;
    on_a.at = (dot(normal, b_in_a.origin) / sine) * across;
    on_a.along = left_of(across);
    cut(a, on_a, of_a_);
    if (of_a_.empty()) return std::nullopt;
    CutLine on_b;
    const Vec3 along = direction_in_frame(b_in_a, {on_a.along.x, on_a.along.y, 0.0});
    on_b.at = on_page(b_in_a, {on_a.at.x, on_a.at.y, 0.0});
    on_b.along = {along.x, along.y};
    cut(b, on_b, of_b_);
    // Left out of the search: where plates turn about an edge, these are long, and all looks would go there.
    runs_.clear();
    for (const Ring& ring : a.rings) add_runs(ring, on_a, runs_);
    for (const Ring& ring : b.rings) add_runs(ring, on_b, runs_);
    std::sort(runs_.begin(), runs_.end(), [](const Stretch& s, const Stretch& t) { return s.from < t.from; });

    const auto inside = [&](double t) {
        const double from_a = a.to_edge(on_a.point(t), kFar);
        return std::min(from_a, b.to_edge(on_b.point(t), std::min(from_a, kFar)));
    };
    const auto furthest = [&](double from, double to) {
        furthest_.clear();
        // What is further from the line is nowhere the nearest.
        const bool few = a.edges.size() <= kFew && b.edges.size() <= kFew;
        const double near = few ? kFar : std::min(kFar, inside(0.5 * (from + to)) + 0.5 * (to - from));
        for (const auto& [shape, line] : {std::pair(&a, &on_a), std::pair(&b, &on_b)}) {
            const auto add = [&furthest = furthest_, line = line](const Segment& edge) {
                furthest.add({line->seen(edge.a), line->seen(edge.b)});
            };
            if (few) {
                for (int i = 0; i < shape->edges.size(); ++i) add(shape->edges[i]);
                continue;
            }
            Box box;
            for (const double t : {from, to}) {
                box.extend(line->point(t) - Vec2{near, near});
                box.extend(line->point(t) + Vec2{near, near});
            }
            shape->edges.query(box, edges_);
            for (const int number : edges_) add(shape->edges[number]);
        }
        return furthest_.find(from, to, kFar);
    };
    std::optional<Crossing> best;
    double at_most = 0.0;
    for (std::size_t i = 0, k = 0; i + 1 < of_a_.size() && k + 1 < of_b_.size();) {
        const double from = std::max(of_a_[i].along, of_b_[k].along);
        const double to = std::min(of_a_[i + 1].along, of_b_[k + 1].along);
        const auto keep = [&](const FurthestInside::Found& there) {
            at_most = std::max(at_most, there.at_most_mm);
            if (best && there.inside_mm <= best->inside_mm) return;
            Crossing found;
            const Vec2 p = on_a.point(there.at);
            found.point = {p.x, p.y, 0.0};
            found.inside_mm = there.inside_mm;
            const double reach_a = reach_of(of_a_[i], of_a_[i + 1]);
            const double reach_b = reach_of(of_b_[k], of_b_[k + 1]);
            found.b_is_longer = reach_b < reach_a;
            found.excess_mm = std::min(reach_a, reach_b);
            found.sine = sine;
            best = found;
        };
        if (from < to &&
            !each_between(runs_, from, to, [&](double begin, double end) { keep(furthest(begin, end)); })) {
            const double middle = 0.5 * (from + to);
            keep({middle, inside(middle), kAlongMm});
        }
        if (of_a_[i + 1].along <= of_b_[k + 1].along) {
            i += 2;
        } else {
            k += 2;
        }
    }
    if (best) best->inside_at_most_mm = at_most;
    return best;
}

}  // namespace popup
