#include "output/card_row.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/text/numbers.h"
#include "output/poses.h"

namespace popup {
namespace {

constexpr int kLengthDecimals = 6;

// The smallest and largest x of any corner at any key, in mm; the spine of what moves stands at 0.
std::pair<double, double> extent(const Assembly& assembly, const HingeTree& tree, const Track& track) {
    const std::size_t count = assembly.plates.size();
    std::vector<Quaternion> turns(count);
    std::vector<Frame> frames(count);
    std::pair<double, double> result{0.0, 0.0};
    if (!moves(assembly)) result = {HUGE_VAL, -HUGE_VAL};
    const auto take = [&result](Vec3 p) {
        result = {std::min(result.first, p.x), std::max(result.second, p.x)};
    };
    for (std::size_t k = 0; k < track.angles_deg.size(); ++k) {
        for (std::size_t i = 0; i < count; ++i) {
            const auto& turn = track.turns[k * count + i];
            turns[i] = {turn[0], turn[1], turn[2], turn[3]};
        }
        compose(assembly, tree, turns, frames);
        for (std::size_t i = 0; i < count; ++i) {
            for (const Vec2 p : assembly.plates[i].outline.outer) take(frames[i].point(p));
        }
    }
    for (const Plate& plate : assembly.plates) {
        if (!plate.stands) continue;
        for (const Vec2 p : plate.outline.outer) take(plate.stands->point(p));
    }
    for (const Trace& trace : assembly.traces) {
        for (const std::vector<Vec3>& line : trace.lines) std::for_each(line.begin(), line.end(), take);
    }
    if (result.first > result.second) return {0.0, 0.0};
    return {rounded(result.first, kLengthDecimals), rounded(result.second, kLengthDecimals)};
}

}  // namespace

std::vector<double> card_shifts(std::span<const SceneCard> cards, const Keys& keys) {
    std::vector<double> shifts(cards.size(), 0.0);
    if (cards.size() < 2) return shifts;
    double left = 0.0;  // where the next card may begin
    for (std::size_t i = 0; i < cards.size(); ++i) {
        const auto [low, high] = extent(*cards[i].assembly, keys.trees[i], keys.tracks[i]);
        if (i > 0) shifts[i] = rounded(left - low, kLengthDecimals);
        left = shifts[i] + high + kCardGapMm;
    }
    return shifts;
}

}  // namespace popup
