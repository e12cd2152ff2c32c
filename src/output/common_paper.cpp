#include "output/common_paper.h"

#include <algorithm>
#include <utility>

#include "base/geometry/regions.h"

namespace popup {
namespace {

constexpr double kLeastMm2 = 1.0;
constexpr double kTouchingMm = 1e-3;

// Whether a line along an edge of the ring, which goes round to the left, has it on one side and the other
// one on the other: what touches has no paper in common.
bool is_beside(const Ring& ring, const Ring& other) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 a = ring[i];
        const Vec2 along = unit(ring[(i + 1) % ring.size()] - a);
        const auto lies_left = [&](Vec2 p) { return cross(along, p - a) >= -kTouchingMm; };
        const auto lies_right = [&](Vec2 p) { return cross(along, p - a) <= kTouchingMm; };
        if (std::all_of(other.begin(), other.end(), lies_right) &&
            std::all_of(ring.begin(), ring.end(), lies_left))
            return true;
    }
    return false;
}

}  // namespace

Ring common_paper(const Polygon& a, const Polygon& b) {
    Ring largest;
    if (is_beside(b.outer, a.outer)) return largest;
    double most = kLeastMm2;
    for (Polygon& part : intersect({a}, {b})) {
        const double paper = area(part);
        if (paper <= most) continue;
        most = paper;
        largest = std::move(part.outer);
    }
    return largest;
}

}  // namespace popup
