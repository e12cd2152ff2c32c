#include "nest/convex_parts.h"

#include <algorithm>
#include <map>
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

// Joins parts of a partition: each part a ring, neighbours found by their common edges.
class Joiner {
 public:
    explicit Joiner(std::vector<GridRing> parts) : parts_(std::move(parts)) {}

    std::vector<GridRing> run() {
        struct Shared {
            double length;
            GridPoint a, b;
        };
        std::map<std::pair<GridPoint, GridPoint>, int> seen;
        std::vector<Shared> shared;
        for (const GridRing& part : parts_) {
            for (std::size_t i = 0; i < part.size(); ++i) {
                const GridPoint a = part[i];
                const GridPoint b = part[(i + 1) % part.size()];
                if (++seen[std::minmax(a, b)] == 2) {
                    const auto [low, high] = std::minmax(a, b);
                    shared.push_back({squared(b - a), low, high});
                }
            }
        }
        std::sort(shared.begin(), shared.end(), [](const Shared& s, const Shared& t) {
            return std::tie(t.length, s.a, s.b) < std::tie(s.length, t.a, t.b);
        });
        for (const Shared& edge : shared) join(edge.a, edge.b);
        std::vector<GridRing> result;
        for (GridRing& part : parts_) {
            drop_straight_corners(part);
            if (part.size() >= 3) result.push_back(std::move(part));
        }
        return result;
    }

 private:
    // The part that has the edge from a to b, and where; -1: none.
    [[nodiscard]] std::pair<int, std::size_t> find(GridPoint a, GridPoint b) const {
        for (std::size_t k = 0; k < parts_.size(); ++k) {
            const GridRing& part = parts_[k];
            for (std::size_t i = 0; i < part.size(); ++i) {
                if (part[i] == a && part[(i + 1) % part.size()] == b) return {static_cast<int>(k), i};
            }
        }
        return {-1, 0};
    }

    void join(GridPoint a, GridPoint b) {
        const auto [left, at_left] = find(a, b);
        const auto [right, at_right] = find(b, a);
        if (left < 0 || right < 0 || left == right) return;
        GridRing& one = nth(parts_, left);
        GridRing& other = nth(parts_, right);
        // Round `one` from b to a, then round `other` from a to b, ends left out.
        GridRing joined;
        for (std::size_t i = 0; i < one.size(); ++i) joined.push_back(one[(at_left + 1 + i) % one.size()]);
        for (std::size_t i = 2; i < other.size(); ++i) joined.push_back(other[(at_right + i) % other.size()]);
        for (std::size_t i = 0; i < joined.size(); ++i) {
            const GridPoint p = joined[(i + joined.size() - 1) % joined.size()];
            if (side(p, joined[i], joined[(i + 1) % joined.size()]) < 0) return;
        }
        one = std::move(joined);
        other.clear();
    }

    std::vector<GridRing> parts_;
};

// One ring being made coarser, the inside on its left.
class Coarsener {
 public:
    Coarsener(std::vector<GridRing>& rings, double furthest) : rings_(rings), furthest_(furthest) {}

    // A step is looked at again only when the corners that make it have changed, and once more before it is
    // taken: an area that was empty may have got a corner.
    void run(double budget) {
        for (std::size_t r = 0; r < rings_.size(); ++r) {
            std::vector<Step>& own = steps_.emplace_back();
            for (std::size_t i = 0; i < rings_[r].size(); ++i) own.push_back(best_at(r, i));
        }
        for (;;) {
            Step* best = nullptr;
            std::size_t ring = 0;
            std::size_t at = 0;
            for (std::size_t r = 0; r < steps_.size(); ++r) {
                for (std::size_t i = 0; i < steps_[r].size(); ++i) {
                    Step& step = steps_[r][i];
                    if (!step.possible || (best != nullptr && step.added >= best->added)) continue;
                    best = &step;
                    ring = r;
                    at = i;
                }
            }
            if (best == nullptr || best->added > budget) return;
            const Step now = best_at(ring, at);
            if (!now.possible || now.added > best->added) {
                *best = now;
                continue;
            }
            budget -= now.added;
            apply(now, ring, at);
        }
    }

 private:
    struct Step {
        bool possible = false;
        bool edge = false;  // a corner instead of the edge that begins here; else this corner is dropped
        GridPoint corner;
        double added = 0.0;
    };

    [[nodiscard]] Step best_at(std::size_t r, std::size_t i) const {
        const Step drop = notch(r, i);
        const Step meet = short_edge(r, i);
        if (!drop.possible) return meet;
        return meet.possible && meet.added < drop.added ? meet : drop;
    }

    [[nodiscard]] GridPoint at(std::size_t ring, std::size_t i) const {
        return rings_[ring][i % rings_[ring].size()];
    }

    // Whether any corner but these lies in the triangle, edges included.
    [[nodiscard]] bool is_empty(GridPoint a, GridPoint b, GridPoint c) const {
        for (const GridRing& ring : rings_) {
            for (const GridPoint p : ring) {
                if (p == a || p == b || p == c) continue;
                if (side(a, b, p) >= 0 && side(b, c, p) >= 0 && side(c, a, p) >= 0) return false;
            }
        }
        return true;
    }

    [[nodiscard]] Step notch(std::size_t r, std::size_t i) const {
        const std::size_t n = rings_[r].size();
        if (n <= 3) return {};
        const GridPoint a = at(r, i + n - 1);
        const GridPoint b = at(r, i);
        const GridPoint c = at(r, i + 1);
        const double twice = -static_cast<double>(cross(b - a, c - b));
        if (twice < 0.0) return {};
        if (twice > 0.0 && !is_empty(a, c, b)) return {};
        return {true, false, {}, 0.5 * twice};
    }

    [[nodiscard]] Step short_edge(std::size_t r, std::size_t i) const {
        const std::size_t n = rings_[r].size();
        if (n <= 4) return {};
        const GridPoint a = at(r, i + n - 1);
        const GridPoint b = at(r, i);
        const GridPoint c = at(r, i + 1);
        const GridPoint d = at(r, i + 2);
        if (side(a, b, c) <= 0 || side(b, c, d) <= 0) return {};
        const auto turn = static_cast<double>(cross(b - a, d - c));
        if (turn <= 0.0) return {};  // the neighbours do not meet beyond the edge
        const double along = static_cast<double>(cross(c - b, d - c)) / turn;
        const GridPoint corner{b.x + std::llround(along * static_cast<double>(b.x - a.x)),
                               b.y + std::llround(along * static_cast<double>(b.y - a.y))};
        const double twice = static_cast<double>(cross(c - b, corner - b)) * -1.0;
        if (twice < 0.0 || twice * twice > furthest_ * furthest_ * squared(c - b)) return {};
        if (squared(corner - b) > 16.0 * furthest_ * furthest_) return {};
        if (!is_empty(b, corner, c)) return {};
        return {true, true, corner, 0.5 * twice};
    }

    void apply(const Step& step, std::size_t r, std::size_t i) {
        GridRing& ring = rings_[r];
        std::vector<Step>& own = steps_[r];
        const std::size_t gone = step.edge ? (i + 1) % ring.size() : i;
        if (step.edge) ring[i] = step.corner;
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(gone));
        own.erase(own.begin() + static_cast<std::ptrdiff_t>(gone));
        // Steps see up to two corners ahead and one behind.
        const std::size_t n = ring.size();
        const std::size_t middle = (gone <= i ? i + n - 1 : i) % n;
        for (std::size_t k = 0; k < std::min<std::size_t>(n, 7); ++k) {
            const std::size_t at = (middle + n - 3 % n + k) % n;
            own[at] = best_at(r, at);
        }
    }

    std::vector<std::vector<Step>> steps_;  // a ring: at each of its corners the cheapest
    std::vector<GridRing>& rings_;
    double furthest_;
};

}  // namespace

std::vector<GridRing> convex_parts(const GridRegion& region) {
    Polygon polygon{in_mm(region.outer), {}};
    for (const GridRing& hole : region.holes) polygon.holes.push_back(in_mm(hole));
    // Cutting a polygon first would put corners beside its edges, by rounding.
    constexpr std::size_t kUncut = 4000;
    const Triangulation triangulation = triangulate(polygon, kUncut);
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
    return Joiner(std::move(parts)).run();
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

GridRegion coarser(const GridRegion& region, double most_added, double furthest) {
    std::vector<GridRing> rings{region.outer};
    rings.insert(rings.end(), region.holes.begin(), region.holes.end());
    Coarsener(rings, furthest).run(most_added);
    GridRegion result{std::move(rings[0]), {}};
    for (std::size_t i = 1; i < rings.size(); ++i) {
        if (rings[i].size() >= 3) result.holes.push_back(std::move(rings[i]));
    }
    return result;
}

}  // namespace popup
