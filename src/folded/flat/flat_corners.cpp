#include "folded/flat/flat_corners.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "base/nth.h"

namespace popup::folded {
namespace {

// The directions of its folds in degrees, in the order of its steps.
std::vector<double> directions(const Sheet& sheet, const Loop& loop) {
    std::vector<double> result;
    result.reserve(loop.steps.size());
    for (const Step& step : loop.steps) {
        for (const Stretch one : nth(sheet.folds, step.fold).stretches) {
            if (one.a != loop.corner_number && one.b != loop.corner_number) continue;
            const Vec2 way =
                sheet.at(one.a == loop.corner_number ? one.b : one.a) - sheet.at(loop.corner_number);
            result.push_back(std::atan2(way.y, way.x) * 180.0 / std::numbers::pi);
        }
    }
    std::sort(result.begin(), result.end());
    return result;
}

}  // namespace

bool FlatCorner::angles_fit() const { return std::abs(every_other_deg - 180.0) <= kKawasakiOffDeg; }

bool FlatCorner::kinds_fit() const {
    const int apart = std::abs(mountains - valleys);
    // Those that may go either way can make the difference larger or smaller by their number.
    return apart - open <= 2 && apart + open >= 2;
}

FlatCorner flat_corner(const Sheet& sheet, const Loop& loop) {
    FlatCorner corner;
    corner.folds = loop.steps.size();
    const std::vector<double> ways = directions(sheet, loop);
    if (corner.even() && ways.size() == loop.steps.size()) {
        corner.every_other_deg = 0.0;
        for (std::size_t i = 0; i < ways.size(); i += 2) corner.every_other_deg += ways[i + 1] - ways[i];
    }
    for (const Step& step : loop.steps) {
        const unsigned ink = nth(sheet.folds, step.fold).ink;
        const bool mountain = (ink & kMountain) != 0;
        const bool valley = (ink & kValley) != 0;
        if (mountain == valley) {
            ++corner.open;
        } else {
            ++(mountain ? corner.mountains : corner.valleys);
        }
    }
    return corner;
}

bool corners_fold_flat(const Sheet& sheet) {
    bool any = false;
    for (const Loop& loop : sheet.loops) {
        if (!loop.corner) continue;
        any = true;
        const FlatCorner corner = flat_corner(sheet, loop);
        if (!corner.even() || !corner.angles_fit() || !corner.kinds_fit()) return false;
    }
    return any;
}

void ask_flat(const Sheet& sheet, Diagnostic& told) {
    if (corners_fold_flat(sheet))
        told.hint("at each of its inner corners this sheet could fold flat: --flat looks whether it does");
}

}  // namespace popup::folded
