// Two triangles are nearest at a corner of one and a point of the other, at a point of an edge of each, or
// where they meet, which an edge of one then does inside the other.
#include "motion/triangle_distance.h"

#include <algorithm>
#include <limits>

namespace popup {
namespace {

using Triangle = std::array<Vec3, 3>;

struct Best {
    double squared = std::numeric_limits<double>::infinity();
    Vec3 on_a, on_b;

    void offer(Vec3 a, Vec3 b) {
        const Vec3 d = b - a;
        const double s = dot(d, d);
        if (s < squared) {
            squared = s;
            on_a = a;
            on_b = b;
        }
    }
};

double clamped(double t) { return std::clamp(t, 0.0, 1.0); }

// The nearest points of two segments.
void segments(Vec3 p, Vec3 p_end, Vec3 q, Vec3 q_end, Best& best) {
    const Vec3 u = p_end - p;
    const Vec3 v = q_end - q;
    const Vec3 w = p - q;
    const double uu = dot(u, u);
    const double vv = dot(v, v);
    const double uv = dot(u, v);
    const double uw = dot(u, w);
    const double vw = dot(v, w);
    const double area = uu * vv - uv * uv;
    double s = area > 1e-14 * uu * vv ? clamped((uv * vw - vv * uw) / area) : 0.0;
    double t = vv > 0.0 ? (uv * s + vw) / vv : 0.0;
    if (t < 0.0 || t > 1.0) {
        t = clamped(t);
        s = uu > 0.0 ? clamped((uv * t - uw) / uu) : 0.0;
    }
    best.offer(p + s * u, q + t * v);
}

// A triangle's plane, and whether points of it lie inside.
struct Face {
    const Triangle& corners;
    Vec3 normal;  // not unit
    double size = 0.0;

    explicit Face(const Triangle& t)
        : corners(t), normal(cross(t[1] - t[0], t[2] - t[0])), size(dot(normal, normal)) {}

    [[nodiscard]] bool flat() const { return size > 0.0; }
    [[nodiscard]] double height(Vec3 p) const { return dot(p - corners[0], normal); }
    // p in the plane, or dropped to it.
    [[nodiscard]] bool covers(Vec3 p) const {
        for (std::size_t i = 0; i < 3; ++i) {
            const Vec3 from = corners.at(i);
            const Vec3 edge = corners.at((i + 1) % 3) - from;
            if (dot(cross(edge, p - from), normal) < 0.0) return false;
        }
        return true;
    }
};

// The corners of `points` against the face; true when an edge goes through it, then `meeting` is where.
bool against(const Triangle& points, const Face& face, bool points_are_b, Best& best, Vec3& meeting) {
    if (!face.flat()) return false;
    std::array<double, 3> heights{};
    for (std::size_t i = 0; i < 3; ++i) {
        heights.at(i) = face.height(points.at(i));
        if (!face.covers(points.at(i))) continue;
        const Vec3 foot = points.at(i) - (heights.at(i) / face.size) * face.normal;
        if (points_are_b)
            best.offer(foot, points.at(i));
        else
            best.offer(points.at(i), foot);
    }
    for (std::size_t i = 0; i < 3; ++i) {
        const double from = heights.at(i);
        const double to = heights.at((i + 1) % 3);
        if ((from > 0.0) == (to > 0.0)) continue;
        const Vec3 at = points.at(i) + (from / (from - to)) * (points.at((i + 1) % 3) - points.at(i));
        if (face.covers(at)) {
            meeting = at;
            return true;
        }
    }
    return false;
}

// Whether b lies beyond a, along `way`, by more than `distance`.
bool beyond(const Triangle& a, const Triangle& b, Vec3 way, double distance) {
    const double end = std::max({dot(a[0], way), dot(a[1], way), dot(a[2], way)});
    const double begin = std::min({dot(b[0], way), dot(b[1], way), dot(b[2], way)});
    const double gap = begin - end;
    return gap > 0.0 && gap * gap > distance * distance * dot(way, way);
}

}  // namespace

bool surely_apart(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, double distance) {
    const Vec3 between = (b[0] + b[1] + b[2]) - (a[0] + a[1] + a[2]);
    if (beyond(a, b, between, distance)) return true;
    const Vec3 normal_a = cross(a[1] - a[0], a[2] - a[0]);
    const Vec3 normal_b = cross(b[1] - b[0], b[2] - b[0]);
    for (const Vec3 normal : {normal_a, normal_b}) {
        if (beyond(a, b, dot(normal, between) < 0.0 ? -normal : normal, distance)) return true;
    }
    // Long ones side by side, nearly in one plane: square to an edge of either.
    for (std::size_t i = 0; i < 3; ++i) {
        if (beyond(a, b, cross(a.at((i + 1) % 3) - a.at(i), normal_a), distance) ||
            beyond(b, a, cross(b.at((i + 1) % 3) - b.at(i), normal_b), distance))
            return true;
    }
    return false;
}

ClosestPoints closest_points(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) {
    Best best;
    Vec3 meeting;
    if (against(b, Face(a), true, best, meeting) || against(a, Face(b), false, best, meeting)) {
        return {0.0, meeting, meeting};
    }
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t k = 0; k < 3; ++k) {
            segments(a.at(i), a.at((i + 1) % 3), b.at(k), b.at((k + 1) % 3), best);
        }
    }
    return {std::sqrt(best.squared), best.on_a, best.on_b};
}

}  // namespace popup
