#include "folded/carton/hull3.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace popup::folded {
namespace {

struct Side {
    std::array<std::size_t, 3> corners;  // counter-clockwise, seen from outside
    Vec3 out;                            // unit
    double away = 0.0;                   // of its plane, along `out`
};

Side side_of(std::span<const Vec3> points, std::size_t a, std::size_t b, std::size_t c) {
    Side side{{a, b, c}, {}, 0.0};
    const Vec3 normal = cross(points[b] - points[a], points[c] - points[a]);
    const double size = length(normal);
    side.out = size > 0.0 ? (1.0 / size) * normal : Vec3{};
    side.away = dot(side.out, points[a]);
    return side;
}

// The number of the point that has the most of something, and how much.
template <typename Measure>
std::pair<std::size_t, double> most(std::span<const Vec3> points, const Measure& measure) {
    std::pair<std::size_t, double> best{0, measure(points[0])};
    for (std::size_t i = 1; i < points.size(); ++i) {
        if (const double one = measure(points[i]); one > best.second) best = {i, one};
    }
    return best;
}

// Four corners that span most; empty: all lie in one plane.
std::vector<Side> first_sides(std::span<const Vec3> points, double enough) {
    const std::size_t a = most(points, [](Vec3 p) { return -p.x - 1e-3 * p.y - 1e-6 * p.z; }).first;
    const auto [b, wide] = most(points, [&](Vec3 p) { return length(p - points[a]); });
    if (wide <= enough) return {};
    const Vec3 along = (1.0 / wide) * (points[b] - points[a]);
    const auto [c, off] = most(points, [&](Vec3 p) { return length(cross(along, p - points[a])); });
    if (off <= enough) return {};
    const Side base = side_of(points, a, b, c);
    const auto [d, high] = most(points, [&](Vec3 p) { return std::abs(dot(base.out, p) - base.away); });
    if (high <= enough) return {};
    const bool above = dot(base.out, points[d]) > base.away;
    const std::size_t second = above ? c : b;
    const std::size_t third = above ? b : c;
    return {side_of(points, a, second, third), side_of(points, a, d, second),
            side_of(points, second, d, third), side_of(points, third, d, a)};
}

}  // namespace

HullSize hull_size(std::span<const Vec3> points) {
    if (points.size() < 4) return {};
    Vec3 low = points[0];
    Vec3 high = points[0];
    for (const Vec3 p : points) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const double enough = 1e-6 * length(high - low);
    std::vector<Side> sides = first_sides(points, enough);
    // Each round adds a point for good: there are no more rounds than points.
    for (std::size_t round = 0; round < points.size() && !sides.empty(); ++round) {
        const auto out_of = [&](Vec3 p) {
            double furthest = -HUGE_VAL;
            for (const Side& side : sides) furthest = std::max(furthest, dot(side.out, p) - side.away);
            return furthest;
        };
        const auto [next, off] = most(points, out_of);
        if (off <= enough) break;
        std::set<std::pair<std::size_t, std::size_t>> rim;  // edges of what the point sees, once each
        std::vector<Side> kept;
        for (const Side& side : sides) {
            if (dot(side.out, points[next]) - side.away <= enough) {
                kept.push_back(side);
                continue;
            }
            for (std::size_t i = 0; i < 3; ++i) {
                const std::pair<std::size_t, std::size_t> edge{side.corners.at(i),
                                                               side.corners.at((i + 1) % 3)};
                if (rim.erase({edge.second, edge.first}) == 0) rim.insert(edge);
            }
        }
        for (const auto& [from, to] : rim) kept.push_back(side_of(points, from, to, next));
        sides = std::move(kept);
    }
    HullSize size;
    for (const Side& side : sides) {
        const Vec3 a = points[side.corners[0]] - low;
        const Vec3 b = points[side.corners[1]] - low;
        const Vec3 c = points[side.corners[2]] - low;
        size.volume += dot(a, cross(b, c)) / 6.0;
        size.surface += 0.5 * length(cross(b - a, c - a));
    }
    return size;
}

}  // namespace popup::folded
