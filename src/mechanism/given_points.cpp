#include "mechanism/given_points.h"

#include <cstddef>

namespace popup {
namespace {

// Whether a point of the fold itself is given on the page to the right of it.
bool is_given_right(const Structure& structure, const PointInfo& info, std::size_t point,
                    const PageFold& seen) {
    return info.page == PointPage::fold && info.side == '-' && seen.left_page != seen.right_page &&
           structure.points[point].page.value_or(structure.ground_page()) != seen.left_page;
}

// A point beside one line of a fold, on the other page.
Vec2 across(const Segment& from, const Segment& to, Vec2 p) {
    const Vec2 along = unit(from.b - from.a);
    const Vec2 there = unit(to.b - to.a);
    return to.a + dot(p - from.a, along) * there + cross(along, p - from.a) * left_of(there);
}

}  // namespace

std::vector<Vec2> points_seen(const Structure& structure, const ElementInfo& info, const PageFold& seen) {
    std::vector<Vec2> points;
    points.reserve(structure.points.size());
    for (std::size_t i = 0; i < structure.points.size(); ++i) {
        const Vec2 at = structure.points[i].at;
        const bool right = is_given_right(structure, info.points[i], i, seen);
        points.push_back(right ? across(seen.on_right, seen.on_left, at) : at);
    }
    return points;
}

void points_as_given(const Structure& structure, const ElementInfo& info, const PageFold& seen,
                     std::vector<Vec2>& points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (is_given_right(structure, info.points[i], i, seen))
            points[i] = across(seen.on_left, seen.on_right, points[i]);
    }
}

}  // namespace popup
