#include "base/geometry/hull.h"

#include <algorithm>

namespace popup {

// Andrew's monotone chain: the lower side from left to right, then the upper side back.
Ring convex_hull(std::vector<Vec2> points) {
    std::sort(points.begin(), points.end(),
              [](Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
    points.erase(std::unique(points.begin(), points.end()), points.end());
    if (points.size() < 3) return points;
    Ring hull;
    const auto add = [&hull](Vec2 p, std::size_t floor) {
        while (hull.size() > floor && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0) {
            hull.pop_back();
        }
        hull.push_back(p);
    };
    for (const Vec2 p : points) add(p, 1);
    const std::size_t floor = hull.size();
    for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], floor);
    hull.pop_back();
    return hull;
}

}  // namespace popup
