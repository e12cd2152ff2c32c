#include "nest/convex_parts.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "base/geometry/triangulate.h"
#include "base/nth.h"

namespace popup {
namespace {

double squared(GridPoint a) {
    return static_cast<double>(a.x) * static_cast<double>(a.x) +
           static_cast<double>(a.y) * static_cast<double>(a.y);
}

int sign(Wide value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

int side(GridPoint a, GridPoint b, GridPoint c) { return sign(cross(b - a, c - a)); }

void drop_straight_corners(GridRing& ring) {
    GridRing kept;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const GridPoint before = ring[(i + ring.size() - 1) % ring.size()];
        const GridPoint after = ring[(i + 1) % ring.size()];
        if (side(before, ring[i], after) != 0) kept.push_back(ring[i]);
    }
    ring = std::move(kept);
}

// Counter-clockwise, without corners in the middle of an edge. Exact.
GridRing hull_of(std::vector<GridPoint> points) {
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    GridRing hull;
    const auto add = [&hull](GridPoint p, std::size_t least) {
        while (hull.size() >= least && side(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
        hull.push_back(p);
    };
    for (const GridPoint p : points) add(p, 2);
    const std::size_t upper = hull.size() + 1;
    for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], upper);
    hull.pop_back();
    return hull;
}

// Joins triangles of a partition to convex parts. Each edge of each triangle has a number; parts are rings of
// such numbers. Cost: n log n.
class Joiner {
 public:
    // Precondition: the triangles run counter-clockwise and do not overlap.
    explicit Joiner(const std::vector<GridRing>& triangles) {
        const std::size_t n = triangles.size() * 3;
        edges_.reserve(n);
        for (const GridRing& triangle : triangles) {
            const auto first = static_cast<int>(edges_.size());
            for (int k = 0; k < 3; ++k)
                edges_.push_back({triangle[index(k)], first + (k + 1) % 3, first + (k + 2) % 3});
        }
        part_of_.resize(triangles.size());
        std::iota(part_of_.begin(), part_of_.end(), 0);
        for (std::size_t t = 0; t < triangles.size(); ++t) starts_.push_back(static_cast<int>(3 * t));
    }

    std::vector<GridRing> run() {
        struct Shared {
            double length;
            GridPoint a, b;
            int forth, back;  // the edges from a to b and from b to a
        };
        struct Seen {
            GridPoint a, b;
            int edge;
        };
        std::vector<Seen> seen;
        seen.reserve(edges_.size());
        for (int e = 0; e < static_cast<int>(edges_.size()); ++e) {
            const GridPoint a = from(e);
            const GridPoint b = to(e);
            seen.push_back({std::min(a, b), std::max(a, b), e});
        }
        std::sort(seen.begin(), seen.end(), [](const Seen& s, const Seen& t) {
            return std::tie(s.a, s.b, s.edge) < std::tie(t.a, t.b, t.edge);
        });
        std::vector<Shared> shared;
        for (std::size_t i = 0; i + 1 < seen.size(); ++i) {
            const Seen& s = seen[i];
            const Seen& t = seen[i + 1];
            if (s.a != t.a || s.b != t.b || from(s.edge) == from(t.edge)) continue;
            const bool forth = from(s.edge) == s.a;
            shared.push_back(
                {squared(s.b - s.a), s.a, s.b, forth ? s.edge : t.edge, forth ? t.edge : s.edge});
            ++i;
        }
        std::sort(shared.begin(), shared.end(), [](const Shared& s, const Shared& t) {
            return std::tie(t.length, s.a, s.b) < std::tie(s.length, t.a, t.b);
        });
        for (const Shared& edge : shared) join(edge.forth, edge.back);
        std::vector<GridRing> result;
        for (const int start : starts_) {
            if (start < 0) continue;
            GridRing part;
            int e = start;
            do {
                part.push_back(from(e));
                e = edges_[index(e)].next;
            } while (e != start);
            drop_straight_corners(part);
            if (part.size() >= 3) result.push_back(std::move(part));
        }
        return result;
    }

 private:
    struct Edge {
        GridPoint from;
        int next, before;
    };
    [[nodiscard]] GridPoint from(int e) const { return edges_[index(e)].from; }
    [[nodiscard]] GridPoint to(int e) const { return from(edges_[index(e)].next); }
    // The part that the edge's triangle belongs to now.
    int part(int e) {
        int p = e / 3;
        while (part_of_[index(p)] != p) {
            part_of_[index(p)] = part_of_[index(part_of_[index(p)])];
            p = part_of_[index(p)];
        }
        return p;
    }

    // Takes out the edge between two parts, if what they make up is convex: parts are, so only the corners
    // where they meet matter.
    void join(int forth, int back) {
        const int left = part(forth);
        const int right = part(back);
        if (left == right) return;
        const Edge& one = edges_[index(forth)];
        const Edge& other = edges_[index(back)];
        const int after_b = one.next;
        const int before_a = one.before;
        const int after_a = other.next;
        const int before_b = other.before;
        if (side(from(before_a), from(after_a), to(after_a)) < 0 ||
            side(from(before_b), from(after_b), to(after_b)) < 0) {
            return;
        }
        link(before_a, after_a);
        link(before_b, after_b);
        starts_[index(left)] = after_b;
        starts_[index(right)] = -1;
        part_of_[index(right)] = left;
    }
    void link(int e, int next) {
        edges_[index(e)].next = next;
        edges_[index(next)].before = e;
    }

    std::vector<Edge> edges_;
    std::vector<int> part_of_;  // a triangle: one that is in the same part; itself: it stands for the part
    std::vector<int> starts_;   // a part: its first edge; -1: it is part of another
};

}  // namespace

std::vector<GridRing> convex_parts(const GridRegion& region) {
    Polygon polygon{in_mm(region.outer), {}};
    for (const GridRing& hole : region.holes) polygon.holes.push_back(in_mm(hole));
    const Triangulation triangulation = triangulate(polygon, kMostUncutCorners);
    std::vector<GridRing> parts;
    parts.reserve(triangulation.triangles.size());
    for (const auto& triangle : triangulation.triangles) {
        GridRing part;
        for (const std::uint32_t corner : triangle) {
            const Vec2 p = triangulation.points[corner];
            part.push_back({to_grid(p.x), to_grid(p.y)});
        }
        if (side(part[0], part[1], part[2]) > 0) parts.push_back(std::move(part));
    }
    return Joiner(parts).run();
}

GridRing widened(const GridRing& part, GridLength by) {
    if (by == 0) return part;
    const std::size_t n = part.size();
    const auto normal = [&](std::size_t i) {
        const GridPoint along = part[(i + 1) % n] - part[i % n];
        const double length = std::sqrt(squared(along));
        return Vec2{static_cast<double>(along.y) / length, -static_cast<double>(along.x) / length};
    };
    const auto reach = static_cast<double>(by);
    std::vector<GridPoint> points;
    for (std::size_t i = 0; i < n; ++i) {
        const GridPoint corner = part[i];
        const Vec2 before = normal(i + n - 1);
        const Vec2 after = normal(i);
        // Where the lines at the distance `by` meet whose normals are a and b.
        const auto meet = [&](Vec2 a, Vec2 b) {
            const Vec2 way = (reach / (1.0 + dot(a, b))) * (a + b);
            points.push_back({corner.x + std::llround(way.x), corner.y + std::llround(way.y)});
        };
        // Corners of a right angle keep their corner.
        constexpr double kKept = -1e-9;
        if (dot(before, after) >= kKept) {
            meet(before, after);
            continue;
        }
        // The middle direction; of a spike the way it points.
        const Vec2 sum = before + after;
        const Vec2 way = length(sum) > 1e-6 ? unit(sum) : left_of(before);
        meet(before, way);
        meet(way, after);
    }
    return hull_of(std::move(points));
}

}  // namespace popup
