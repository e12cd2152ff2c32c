// Triangles as rows of samples.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "output/still/camera.h"

namespace popup::still {

// Whole numbers next to a value; library functions are calls without SSE 4. Precondition: within ±1e9.
inline int whole_from(double value) {
    const int near = static_cast<int>(value);
    return near + (near < value ? 1 : 0);
}
inline int whole_to(double value) {
    const int near = static_cast<int>(value);
    return near - (near > value ? 1 : 0);
}

inline constexpr std::size_t kMostCorners = 48;

// Calls visit(y, first, last) for each row from `top` up to `bottom` (not with it) in which samples lie in a
// convex polygon of at most kMostCorners: those whose middles lie between first and last, both included, 0 to
// width - 1. Middles on an edge belong to it. Cost: its rows times its corners.
template <typename Visit>
void each_row(std::span<const Seen> corners, int width, int top, int bottom, const Visit& visit) {
    double low = corners.front().y;
    double high = low;
    double area = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Seen& at = corners[i];
        low = std::min(low, at.y);
        high = std::max(high, at.y);
        if (i < 2) continue;
        const Seen& last = corners[i - 1];
        area +=
            (last.x - corners[0].x) * (at.y - corners[0].y) - (last.y - corners[0].y) * (at.x - corners[0].x);
    }
    low = std::max(low - 0.5, static_cast<double>(top));
    high = std::min(high - 0.5, bottom - 1.0);
    if (!(low <= high) || std::abs(area) < 1e-9) return;
    const int first_row = whole_from(low);
    const int last_row = whole_to(high);
    if (first_row > last_row) return;
    struct Side {
        double low, high, x, y, by;
    };
    std::array<Side, kMostCorners> sides;
    std::size_t count = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const Seen& p = corners[k];
        const Seen& q = corners[k + 1 < corners.size() ? k + 1 : 0];
        // A level side has its ends in common with its neighbours.
        if (p.y == q.y) continue;
        sides[count++] = {std::min(p.y, q.y), std::max(p.y, q.y), p.x, p.y, (q.x - p.x) / (q.y - p.y)};
    }
    const double most = width - 1.0;
    for (int y = first_row; y <= last_row; ++y) {
        const double middle = y + 0.5;
        double left = HUGE_VAL;
        double right = -HUGE_VAL;
        for (std::size_t k = 0; k < count; ++k) {
            const Side& side = sides[k];
            if (side.low > middle || side.high < middle) continue;
            const double x = side.x + (middle - side.y) * side.by;
            left = std::min(left, x);
            right = std::max(right, x);
        }
        const double from = std::max(left - 0.5, 0.0);
        const double to = std::min(right - 0.5, most);
        if (!(from <= to)) continue;
        const int first = whole_from(from);
        const int last = whole_to(to);
        if (first <= last) visit(y, first, last);
    }
}

// Calls visit(polygon) with convex polygons that some triangles make up, by the numbers of their corners:
// those of a fan, which follow one another round its first corner, as one. `seen`: the corners.
template <typename Visit>
void each_convex(std::span<const std::uint32_t> triangles, std::span<const Seen> seen, const Visit& visit) {
    std::array<Seen, kMostCorners> polygon;
    const auto turn = [](const Seen& a, const Seen& b, const Seen& c) {
        return (b.x - a.x) * (c.y - b.y) - (b.y - a.y) * (c.x - b.x);
    };
    for (std::size_t i = 0; i + 2 < triangles.size();) {
        const std::uint32_t hub = triangles[i];
        std::size_t count = 0;
        for (std::size_t k = 0; k < 3; ++k) polygon[count++] = seen[triangles[i + k]];
        const double side = turn(polygon[0], polygon[1], polygon[2]);
        for (i += 3; i + 2 < triangles.size() && count < kMostCorners; i += 3) {
            if (triangles[i] != hub || triangles[i + 1] != triangles[i - 1]) break;
            const Seen& next = seen[triangles[i + 2]];
            if (!(side * turn(polygon[count - 2], polygon[count - 1], next) > 0.0) ||
                !(side * turn(polygon[0], polygon[1], next) > 0.0) ||
                !(side * turn(polygon[0], polygon[count - 1], next) > 0.0))
                break;
            polygon[count++] = next;
        }
        visit(std::span<const Seen>(polygon.data(), count));
    }
}

}  // namespace popup::still
