#include "base/geometry/ears.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace popup {
namespace {

constexpr std::size_t kMostCorners = 200;
constexpr double kAreaError = 1e-12;  // that is rounding

double twice_area(Vec2 a, Vec2 b, Vec2 c) { return cross(b - a, c - a); }

// What is left of a ring, as a circle of corners.
class Rest {
 public:
    explicit Rest(const std::vector<Vec2>& points)
        : points_(points), before_(points.size()), after_(before_) {
        const std::size_t n = points.size();
        for (std::size_t i = 0; i < n; ++i) {
            before_[i] = (i + n - 1) % n;
            after_[i] = (i + 1) % n;
            if (turn(i) < 0.0) inward_.push_back(i);
        }
    }

    [[nodiscard]] std::size_t before(std::size_t i) const { return before_[i]; }
    [[nodiscard]] std::size_t after(std::size_t i) const { return after_[i]; }
    [[nodiscard]] double turn(std::size_t i) const {
        return twice_area(points_[before_[i]], points_[i], points_[after_[i]]);
    }
    // A corner with nothing of the ring within the triangle that it makes, or on its sides.
    [[nodiscard]] bool is_ear(std::size_t i) const {
        const Vec2 a = points_[before_[i]];
        const Vec2 b = points_[i];
        const Vec2 c = points_[after_[i]];
        if (!(twice_area(a, b, c) > 0.0)) return false;
        for (const std::size_t k : inward_) {
            const Vec2 p = points_[k];
            if (p == a || p == b || p == c) continue;
            if (twice_area(a, b, p) >= 0.0 && twice_area(b, c, p) >= 0.0 && twice_area(c, a, p) >= 0.0)
                return false;
        }
        return true;
    }
    void cut_off(std::size_t i) {
        after_[before_[i]] = after_[i];
        before_[after_[i]] = before_[i];
        // What no longer points inwards never does again; only these two may have changed.
        std::erase_if(inward_, [&](std::size_t k) {
            return k == i || ((k == before_[i] || k == after_[i]) && turn(k) >= 0.0);
        });
    }

 private:
    const std::vector<Vec2>& points_;
    std::vector<std::size_t> before_, after_;
    std::vector<std::size_t> inward_;  // corners that point inwards, of those left
};

// The ring without doubled corners, and without those on a straight edge.
std::vector<Vec2> corners_of(const Ring& ring) {
    std::vector<Vec2> single;
    for (const Vec2 p : ring) {
        if (single.empty() || single.back() != p) single.push_back(p);
    }
    while (single.size() > 1 && single.back() == single.front()) single.pop_back();
    std::vector<Vec2> corners;
    const std::size_t n = single.size();
    for (std::size_t i = 0; i < n; ++i) {
        if (twice_area(single[(i + n - 1) % n], single[i], single[(i + 1) % n]) != 0.0)
            corners.push_back(single[i]);
    }
    return corners;
}

double area_of(const Triangulation& triangulation) {
    double twice = 0.0;
    for (const auto& [a, b, c] : triangulation.triangles)
        twice += twice_area(triangulation.points[a], triangulation.points[b], triangulation.points[c]);
    return 0.5 * twice;
}

}  // namespace

Triangulation quick_triangles(const Polygon& polygon) {
    std::optional<Triangulation> ears = clip_ears(polygon);
    return ears ? *std::move(ears) : triangulate(polygon);
}

std::optional<Triangulation> clip_ears(const Polygon& polygon) {
    if (!polygon.holes.empty() || polygon.outer.size() > kMostCorners) return std::nullopt;
    Triangulation result{corners_of(polygon.outer), {}};
    std::size_t left = result.points.size();
    if (left < 3) return std::nullopt;
    Rest rest(result.points);
    std::size_t at = 0;
    for (std::size_t tried = 0; left > 3; ++tried) {
        if (tried > left) return std::nullopt;
        const std::size_t next = rest.after(at);
        if (rest.is_ear(at)) {
            result.triangles.push_back({static_cast<std::uint32_t>(rest.before(at)),
                                        static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(next)});
            rest.cut_off(at);
            --left;
            tried = 0;
            // The neighbour's turn comes later: one cut after the other would give a fan of long triangles.
            at = rest.after(next);
        } else {
            at = next;
        }
    }
    if (!(rest.turn(at) > 0.0)) return std::nullopt;
    result.triangles.push_back({static_cast<std::uint32_t>(rest.before(at)), static_cast<std::uint32_t>(at),
                                static_cast<std::uint32_t>(rest.after(at))});
    const Box box = bounds(polygon.outer);
    const double wanted = area(polygon);
    if (std::abs(area_of(result) - wanted) > kAreaError * (wanted + box.width() * box.height()))
        return std::nullopt;
    return result;
}

}  // namespace popup
