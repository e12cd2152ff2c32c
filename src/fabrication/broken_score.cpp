#include "fabrication/broken_score.h"

#include <algorithm>
#include <cmath>

namespace popup {
namespace {

constexpr double kPeriodMm = 8.0;
constexpr double kGapMm = 1.0;
constexpr double kMostOfLine = 0.25;

}  // namespace

bool is_broken(Operation fold, const Profile& profile, ScoreSide side) {
    if (!is_fold(fold) || profile.away_folds == AwayFolds::whole || profile.folds != FoldStyle::score)
        return false;
    switch (side) {
        case ScoreSide::front:
            return fold != Operation::valley;
        case ScoreSide::back:
            return fold == Operation::valley;
        case ScoreSide::both:
            return false;
    }
    broken_invariant("a score side is one of its enumerators", __FILE__, __LINE__);
}

std::vector<Segment> broken_score(const Segment& line) {
    const double length = distance(line.a, line.b);
    const double gaps = std::max(1.0, std::round(length / kPeriodMm));
    const double half = 0.5 * std::min(kGapMm / length, kMostOfLine / gaps);
    std::vector<Segment> scored;
    scored.reserve(static_cast<std::size_t>(gaps) + 1);
    double from = 0.0;
    for (int i = 0; i < static_cast<int>(gaps); ++i) {
        const double middle = (i + 0.5) / gaps;
        scored.push_back({lerp(line.a, line.b, from), lerp(line.a, line.b, middle - half)});
        from = middle + half;
    }
    scored.push_back({lerp(line.a, line.b, from), line.b});
    return scored;
}

}  // namespace popup
