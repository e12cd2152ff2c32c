// How large the panels of a flat sheet are, along directions and from their folds.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/nth.h"
#include "folded/sheet.h"
#include "popup/geometry.h"

namespace popup::folded {

// Lengths are mm, areas mm², and panels and folds are numbers of the sheet, which must outlive it. Cost:
// linear in the corners of the panel.
class PanelMeasures {
 public:
    explicit PanelMeasures(const Sheet& sheet) : sheet_(sheet) {}

    // Precondition: the fold is at the panel.
    [[nodiscard]] int other_side(int fold, int panel) const {
        const Fold& one = nth(sheet_.folds, fold);
        return one.left == panel ? one.right : one.left;
    }
    [[nodiscard]] double area_of(int panel) const {
        return area(sheet_.outline_of(nth(sheet_.panels, panel)));
    }
    // From the least to the most along a direction.
    [[nodiscard]] Vec2 extent(int panel, Vec2 dir) const {
        Vec2 reach{HUGE_VAL, -HUGE_VAL};
        for (const int corner : nth(sheet_.panels, panel).outer) {
            const double at = dot(dir, sheet_.at(corner));
            reach = {std::min(reach.x, at), std::max(reach.y, at)};
        }
        return reach;
    }
    // How far a panel reaches from the fold that it hangs on.
    [[nodiscard]] double depth_from(int fold, int panel) const {
        const Segment line = sheet_.line_of(nth(sheet_.folds, fold));
        const Vec2 out = left_of(unit(line.b - line.a));
        const Vec2 reach = extent(panel, out);
        const double at = dot(out, line.a);
        return std::max(reach.y - at, at - reach.x);
    }
    [[nodiscard]] double length_of(int fold) const {
        const Segment line = sheet_.line_of(nth(sheet_.folds, fold));
        return distance(line.a, line.b);
    }
    [[nodiscard]] double width_of(int panel, Vec2 across) const {
        const Vec2 wide = extent(panel, across);
        return wide.y - wide.x;
    }

 private:
    const Sheet& sheet_;
};

}  // namespace popup::folded
