// Both planes have one line in common, along which s runs on both plates; x is a point's distance from it.
// When a plate moves square to itself, what it has in common with the other is, one instant after another,
// what their slices parallel to that line have in common: that of the other at x, and its own at x times the
// cosine of the angle between the planes, for it is seen at a slant. The first x at which the slices have
// nothing in common is where they part, and the way to there is x times the sine of the angle.
#include "motion/depth.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace popup {
namespace {

constexpr double kParallel = 1e-9;  // sine of the angle between planes that never meet
constexpr double kNothing = 1e-7;   // mm: slices that have less than this in common have nothing in common

struct Flat {
    double s, x;
};
using FlatRings = std::vector<std::vector<Flat>>;

// An edge as the moment goes on: its s at t, from t = from to t = to.
struct Edge {
    double from, to;
    double start, slope;
    [[nodiscard]] double at(double t) const { return start + slope * (t - from); }
};

struct Span {
    double from, to;
};

// Where the line at x is on the plate, as pairs of s.
std::vector<double> slice_at(const FlatRings& rings, double x) {
    std::vector<double> ends;
    for (const std::vector<Flat>& ring : rings) {
        for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
            const Flat p = ring[j];
            const Flat q = ring[i];
            if ((p.x >= x) != (q.x >= x)) ends.push_back(p.s + (q.s - p.s) * ((x - p.x) / (q.x - p.x)));
        }
    }
    std::sort(ends.begin(), ends.end());
    return ends;
}

// The same at x = 0 for a plate that is hardly seen to move: what lies along an edge only touches it.
std::vector<Edge> still_edges(const FlatRings& rings) {
    const std::vector<double> left = slice_at(rings, -kTouchMm);
    const std::vector<double> right = slice_at(rings, kTouchMm);
    std::vector<Edge> edges;
    for (std::size_t i = 0, k = 0; i + 1 < left.size() && k + 1 < right.size();) {
        const Span both{std::max(left[i], right[k]), std::min(left[i + 1], right[k + 1])};
        if (both.from < both.to) {
            edges.push_back({0.0, HUGE_VAL, both.from, 0.0});
            edges.push_back({0.0, HUGE_VAL, both.to, 0.0});
        }
        (left[i + 1] < right[k + 1] ? i : k) += 2;
    }
    return edges;
}

// The edges of slices at x = way × t, for t > 0; those that begin first come first.
std::vector<Edge> edges_of(const FlatRings& rings, double way) {
    std::vector<Edge> edges;
    for (const std::vector<Flat>& ring : rings) {
        for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
            Flat p = ring[j];
            Flat q = ring[i];
            p.x /= way;
            q.x /= way;
            if (p.x > q.x) std::swap(p, q);
            if (q.x <= 0.0 || p.x == q.x) continue;
            edges.push_back({p.x, q.x, p.s, (q.s - p.s) / (q.x - p.x)});
        }
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& p, const Edge& q) { return p.from < q.from; });
    return edges;
}

// Edges of one plate that the slices of a stretch of t meet, in their order.
class Slices {
 public:
    explicit Slices(std::vector<Edge> edges) : edges_(std::move(edges)) {}
    [[nodiscard]] const std::vector<Edge>& edges() const { return edges_; }
    // Stretches ascend.
    const std::vector<const Edge*>& within(Span stretch) {
        const double middle = 0.5 * (stretch.from + stretch.to);
        std::erase_if(met_, [&](const Edge* edge) { return edge->to < middle; });
        for (; next_ < edges_.size() && edges_[next_].from <= middle; ++next_) {
            if (edges_[next_].to >= middle) met_.push_back(&edges_[next_]);
        }
        std::sort(met_.begin(), met_.end(),
                  [&](const Edge* p, const Edge* q) { return p->at(middle) < q->at(middle); });
        return met_;
    }

 private:
    std::vector<Edge> edges_;
    std::size_t next_ = 0;
    std::vector<const Edge*> met_;
};

// Cuts from a stretch of t what leaves one edge less than kNothing behind another.
void keep_ahead(const Edge& behind, const Edge& ahead, Span& stretch) {
    const double slope = ahead.slope - behind.slope;
    const double first = ahead.at(stretch.from) - behind.at(stretch.from) - kNothing;
    const double last = first + slope * (stretch.to - stretch.from);
    if (first > 0.0 && last > 0.0) return;
    if (first <= 0.0 && last <= 0.0) {
        stretch.to = stretch.from;
        return;
    }
    const double turn = stretch.from - first / slope;
    (first > 0.0 ? stretch.to : stretch.from) = turn;
}

// The stretches of t within `whole` in which slices have something in common.
void common(const std::vector<const Edge*>& a, const std::vector<const Edge*>& b, Span whole,
            std::vector<Span>& found) {
    found.clear();
    for (std::size_t i = 0; i + 1 < a.size(); i += 2) {
        for (std::size_t k = 0; k + 1 < b.size(); k += 2) {
            Span one = whole;
            keep_ahead(*a[i], *b[k + 1], one);
            if (one.from < one.to) keep_ahead(*b[k], *a[i + 1], one);
            if (one.from < one.to) found.push_back(one);
        }
    }
    std::sort(found.begin(), found.end(), [](const Span& p, const Span& q) { return p.from < q.from; });
}

// The first t > 0 at which the slices of a at x = way t and of b at x = slant way t have nothing in common.
double first_gap(const FlatRings& a, const FlatRings& b, double way, double slant) {
    Slices of_a(edges_of(a, way));
    double end = 0.0;  // of a, behind which there are no slices
    for (const Edge& edge : of_a.edges()) end = std::max(end, edge.to);
    const bool still = std::abs(slant) * end < kTouchMm;
    Slices of_b(still ? still_edges(b) : edges_of(b, way * slant));
    std::vector<double> stops;
    for (const Slices* slices : {&of_a, &of_b}) {
        for (const Edge& edge : slices->edges()) {
            for (const double t : {edge.from, edge.to}) {
                if (t > 0.0 && t < end) stops.push_back(t);
            }
        }
    }
    stops.push_back(end);
    std::sort(stops.begin(), stops.end());
    double reached = 0.0;
    double from = 0.0;
    std::vector<Span> found;
    for (const double to : stops) {
        if (to - from <= kNothing) continue;
        const Span stretch{from, to};
        common(of_a.within(stretch), of_b.within(stretch), stretch, found);
        for (const Span& one : found) {
            if (one.from > reached + kNothing) break;
            reached = std::max(reached, one.to);
        }
        if (reached < to - kNothing) break;
        from = to;
    }
    return reached;
}

}  // namespace

double depth_mm(const PlateShape& a, const PlateShape& b, const Frame& b_in_a) {
    const Vec3 normal = b_in_a.normal();
    const Vec2 tilt{normal.x, normal.y};
    const double sine = length(tilt);
    if (sine < kParallel) return 0.0;
    const Vec2 across = (1.0 / sine) * tilt;
    const Vec2 along = left_of(across);
    const Vec2 at = (dot(normal, b_in_a.origin) / sine) * across;
    FlatRings flat_a;
    for (const Ring& ring : a.rings) {
        std::vector<Flat>& flat = flat_a.emplace_back();
        for (const Vec2 p : ring) flat.push_back({dot(along, p - at), dot(across, p - at)});
    }
    const Vec3 along_b = direction_in_frame(b_in_a, {along.x, along.y, 0.0});
    const Vec2 on_b{along_b.x, along_b.y};
    const Vec2 across_b = left_of(on_b);
    const Vec2 at_b = on_page(b_in_a, {at.x, at.y, 0.0});
    FlatRings flat_b;
    for (const Ring& ring : b.rings) {
        std::vector<Flat>& flat = flat_b.emplace_back();
        for (const Vec2 p : ring) flat.push_back({dot(on_b, p - at_b), dot(across_b, p - at_b)});
    }
    const Vec3 out = b_in_a.point(at_b + across_b) - b_in_a.point(at_b);
    const double slant = dot(across, {out.x, out.y});
    double least = HUGE_VAL;
    for (const double way : {-1.0, 1.0}) {
        least = std::min(least, first_gap(flat_a, flat_b, way, slant));
        least = std::min(least, first_gap(flat_b, flat_a, way, slant));
    }
    return least * sine;
}

}  // namespace popup
