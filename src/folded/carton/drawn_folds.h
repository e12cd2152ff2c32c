// The folds of a carton's panels as they are drawn, however far they are folded in the end.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/nth.h"
#include "folded/carton/panel_measures.h"
#include "folded/lower.h"
#include "folded/sheet.h"

namespace popup::folded {

// Panels and folds are numbers of the sheet; it and the pattern must outlive this.
class DrawnFolds : public PanelMeasures {
 public:
    static constexpr double kGussetDeg = 10.0;  // a fold that is drawn folded by less parts a wall

    DrawnFolds(const CreasePattern& pattern, const Sheet& sheet)
        : PanelMeasures(sheet), pattern_(pattern), sheet_(sheet), folds_(folds_by_panel(sheet)) {}

    // 1: walls stand up to the front, which they do at first; -1: to the back.
    void look_from(double front) { front_ = front; }
    [[nodiscard]] double front() const { return front_; }

    [[nodiscard]] const std::vector<int>& folds_of(int panel) const { return nth(folds_, panel); }

    // How far it is drawn folded, or else meant to be.
    [[nodiscard]] double drawn_deg(const Fold& fold) const {
        return nth(pattern_.lines, fold.line).fold_deg.value_or(fold.target == 0.0 ? 0.0 : 90.0);
    }

    enum class Folded {
        up,      // to the front, and not flat: a box's walls are
        over,    // to the front, and perhaps flat: hems
        gusset,  // what parts a wall: to the back, and flat in the end
    };
    // The longest fold of a panel that is parallel to `along`, `least` long at least, and on the side of
    // `across` beyond its middle, `but` left out; -1 for none.
    [[nodiscard]] int fold_on(int panel, Vec2 along, Vec2 across, double least, int but,
                              Folded how = Folded::up) const {
        const Vec2 reach = extent(panel, across);
        int best = -1;
        double longest = least;
        for (const int number : folds_of(panel)) {
            if (number == but || !is_folded(number, how)) continue;
            const Segment line = sheet_.line_of(nth(sheet_.folds, number));
            const Vec2 way = line.b - line.a;
            if (std::abs(cross(along, way)) > kParallel * length(way)) continue;
            if (dot(across, line.a) < 0.5 * (reach.x + reach.y)) continue;
            if (length(way) < longest * (1.0 + 1e-9)) continue;
            longest = length(way);
            best = number;
        }
        return best;
    }

    // A direction for each set of parallel folds of a panel, upwards, or to the right.
    [[nodiscard]] std::vector<Vec2> directions_of(int panel) const {
        std::vector<Vec2> found;
        for (const int number : folds_of(panel)) {
            const Segment line = sheet_.line_of(nth(sheet_.folds, number));
            Vec2 dir = unit(line.b - line.a);
            if (dir.y < -kParallel || (dir.y < kParallel && dir.x < 0.0)) dir = -dir;
            const auto like = [&](Vec2 other) { return std::abs(cross(dir, other)) <= kParallel; };
            if (std::none_of(found.begin(), found.end(), like)) found.push_back(dir);
        }
        return found;
    }

 private:
    static constexpr double kParallel = 0.02;     // sine of the angle between folds that are called parallel
    static constexpr double kUprightDeg = 170.0;  // a fold that is drawn folded by more stands on nothing

    // 1 of valleys, -1 of mountains: as they are drawn, however far they are folded.
    [[nodiscard]] double sense(const Fold& fold) const {
        const CreaseUse use = nth(pattern_.lines, fold.line).use;
        if (use == CreaseUse::valley) return 1.0;
        if (use == CreaseUse::mountain) return -1.0;
        return fold.target < 0.0 ? -1.0 : fold.target > 0.0 ? 1.0 : 0.0;
    }
    [[nodiscard]] bool is_folded(int fold, Folded how) const {
        const Fold& one = nth(sheet_.folds, fold);
        if (how == Folded::gusset) return sense(one) == -front_ && drawn_deg(one) < kGussetDeg;
        return sense(one) == front_ && (how == Folded::over || drawn_deg(one) < kUprightDeg);
    }

    const CreasePattern& pattern_;
    const Sheet& sheet_;
    std::vector<std::vector<int>> folds_;  // by panel
    double front_ = 1.0;
};

}  // namespace popup::folded
