#include "folded/carton/carton_size.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "base/nth.h"
#include "folded/carton/hull3.h"

namespace popup::folded {
namespace {

// Along the longest edge of a panel, across it, and upright on it.
Vec3 extent(const RoughShape& shape, const std::vector<Vec3>& points, const Rigid3& frame, int base) {
    const Ring ring = shape.sheet.outline_of(nth(shape.sheet.panels, base)).outer;
    Vec2 along{1, 0};
    double most = 0.0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 edge = ring[(i + 1) % ring.size()] - ring[i];
        if (length(edge) <= most * (1.0 + 1e-9)) continue;
        most = length(edge);
        along = (1.0 / most) * edge;
    }
    const Vec3 x = frame.direction({along.x, along.y, 0});
    const Vec3 y = frame.direction({-along.y, along.x, 0});
    Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL};
    Vec3 high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (const Vec3 p : points) {
        const Vec3 at{dot(p, x), dot(p, y), dot(p, frame.axes[2])};
        low = {std::min(low.x, at.x), std::min(low.y, at.y), std::min(low.z, at.z)};
        high = {std::max(high.x, at.x), std::max(high.y, at.y), std::max(high.z, at.z)};
    }
    return high - low;
}

}  // namespace

void tell_carton_size(const RoughShape& shape, double board_mm, Diagnostics& diagnostics) {
    const FoldedState state = shape.state();
    for (std::size_t piece = 0; piece < shape.sheet.cuts.size(); ++piece) {
        Box blank;
        double paper = 0.0;
        std::vector<Vec3> points;
        int base = -1;
        for (const int panel : shape.tree.order) {
            const Panel& one = nth(shape.sheet.panels, panel);
            if (one.piece != static_cast<int>(piece)) continue;
            if (base < 0) base = panel;
            paper += area(shape.sheet.outline_of(one));
            for (const int corner : one.outer) {
                blank.extend(shape.sheet.at(corner));
                points.push_back(state.place({panel, corner}));
            }
        }
        if (base < 0) continue;
        const std::string whose =
            shape.sheet.cuts.size() == 1 ? std::string() : fmt::format("sheet-{}: ", piece + 1);
        std::string text = fmt::format("{}the blank is {:.2f} × {:.2f} mm, with {:.1f} cm² of board", whose,
                                       blank.width(), blank.height(), paper / 100.0);
        const HullSize hull = hull_size(points);
        const double inside = hull.volume - 0.5 * board_mm * hull.surface;
        if (inside > 0.0) {
            const Vec3 size = extent(shape, points, state.frame(base), base);
            text += fmt::format("; closed it is {:.2f} × {:.2f} × {:.2f} mm outside, and holds {:.1f} cm³",
                                size.x + board_mm, size.y + board_mm, size.z + board_mm, inside / 1000.0);
        }
        diagnostics.remark("carton-size", {}, std::move(text));
    }
}

}  // namespace popup::folded
