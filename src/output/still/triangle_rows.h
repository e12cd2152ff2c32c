// Triangles as rows of samples.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "output/still/camera.h"

namespace popup::still {

// Calls visit(y, first, last, near, step) for each row from `top` up to `bottom` (not with it) in which
// samples lie in the triangle: those whose middles lie between first and last, both included, 0 to width - 1.
// `near` is that of the first, `step` what it grows by to the next. Middles on an edge belong to it. Cost:
// its rows.
template <typename Visit>
void each_row(const std::array<Seen, 3>& corners, int width, int top, int bottom, const Visit& visit) {
    const auto& [a, b, c] = corners;
    const double area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (std::abs(area) < 1e-9) return;
    const double by_x = ((b.near - a.near) * (c.y - a.y) - (c.near - a.near) * (b.y - a.y)) / area;
    const double by_y = ((c.near - a.near) * (b.x - a.x) - (b.near - a.near) * (c.x - a.x)) / area;
    const auto [low, high] = std::minmax({a.y, b.y, c.y});
    const double first_row = std::max(std::ceil(low - 0.5), static_cast<double>(top));
    const double last_row = std::min(std::floor(high - 0.5), static_cast<double>(bottom) - 1.0);
    if (!(first_row <= last_row)) return;
    for (int y = static_cast<int>(first_row); y <= static_cast<int>(last_row); ++y) {
        const double middle = y + 0.5;
        double left = HUGE_VAL;
        double right = -HUGE_VAL;
        for (std::size_t k = 0; k < 3; ++k) {
            const Seen& p = corners.at(k);
            const Seen& q = corners.at((k + 1) % 3);
            if (std::min(p.y, q.y) > middle || std::max(p.y, q.y) < middle) continue;
            if (p.y == q.y) {
                left = std::min({left, p.x, q.x});
                right = std::max({right, p.x, q.x});
                continue;
            }
            const double x = p.x + (middle - p.y) / (q.y - p.y) * (q.x - p.x);
            left = std::min(left, x);
            right = std::max(right, x);
        }
        const double from = std::max(std::ceil(left - 0.5), 0.0);
        const double to = std::min(std::floor(right - 0.5), static_cast<double>(width) - 1.0);
        if (!(from <= to)) continue;
        const double near = a.near + by_x * (from + 0.5 - a.x) + by_y * (middle - a.y);
        visit(y, static_cast<int>(from), static_cast<int>(to), near, by_x);
    }
}

}  // namespace popup::still
