#include "fabrication/broken_score.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

namespace popup {
namespace {

constexpr double kPeriodMm = 8.0;
constexpr double kGapMm = 1.0;
constexpr double kMostOfLine = 0.25;
constexpr double kMostTurn = 30.0 / 180.0 * std::numbers::pi;  // from one chord of a curve to the next
constexpr double kChordsMeetMm = 1e-3;
constexpr double kScoresNothingMm = 1e-6;

// Lines by where they end.
class Chains {
 public:
    explicit Chains(std::span<const Segment> lines) : lines_(lines) {
        for (std::size_t i = 0; i < lines.size(); ++i) {
            if (lines[i].a == lines[i].b) continue;
            ends_[key(lines[i].a)].push_back({i, false});
            ends_[key(lines[i].b)].push_back({i, true});
        }
    }

    std::vector<std::vector<FoldWay>> folds() {
        std::vector<std::vector<FoldWay>> folds;
        std::vector<char> taken(lines_.size(), 0);
        for (std::size_t i = 0; i < lines_.size(); ++i) {
            if (taken[i] != 0 || lines_[i].a == lines_[i].b) continue;
            folds.push_back(chain_from(first_of_chain({i, false})));
            for (const FoldWay& way : folds.back()) taken[way.line] = 1;
        }
        return folds;
    }

 private:
    using Way = FoldWay;  // of ends: whether it is the second
    using Key = std::pair<std::int64_t, std::int64_t>;
    static Key key(Vec2 p) { return {std::llround(p.x / kChordsMeetMm), std::llround(p.y / kChordsMeetMm)}; }
    [[nodiscard]] Vec2 end_of(Way way) const { return way.back ? lines_[way.line].a : lines_[way.line].b; }
    [[nodiscard]] Vec2 direction(Way way) const {
        const Vec2 along = lines_[way.line].b - lines_[way.line].a;
        return way.back ? Vec2{-along.x, -along.y} : along;
    }

    // What goes on where a line ends.
    [[nodiscard]] std::optional<Way> next(Way way) const {
        const std::vector<Way>& here = ends_.at(key(end_of(way)));
        if (here.size() != 2 || here[0].line == here[1].line) return std::nullopt;
        const Way other = here[here[0].line == way.line ? 1 : 0];
        const Vec2 from = direction(way);
        const Vec2 to = direction(other);
        if (std::abs(std::atan2(cross(from, to), dot(from, to))) > kMostTurn) return std::nullopt;
        return other;
    }
    // Back along the chain from this line; of a closed one, the line itself.
    [[nodiscard]] Way first_of_chain(Way way) const {
        Way first{way.line, !way.back};
        for (auto more = next(first); more; more = next(first)) {
            if (more->line == way.line) return way;
            first = *more;
        }
        return {first.line, !first.back};
    }
    [[nodiscard]] std::vector<Way> chain_from(Way way) const {
        std::vector<Way> chain{way};
        for (auto more = next(way); more && more->line != chain.front().line; more = next(*more))
            chain.push_back(*more);
        return chain;
    }

    std::span<const Segment> lines_;
    std::map<Key, std::vector<Way>> ends_;
};

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

std::vector<std::vector<FoldWay>> folds_of(std::span<const Segment> lines) { return Chains(lines).folds(); }

std::vector<FoldPart> parts_of_folds(std::span<const Segment> lines) {
    std::vector<FoldPart> parts(lines.size());
    for (const std::vector<FoldWay>& fold : folds_of(lines)) {
        double length = 0.0;
        for (const FoldWay& way : fold) {
            parts[way.line] = {length, 0.0, way.back};
            length += distance(lines[way.line].a, lines[way.line].b);
        }
        for (const FoldWay& way : fold) parts[way.line].whole = length;
    }
    return parts;
}

std::vector<Segment> broken_score(const Segment& line, const FoldPart& part) {
    const Segment along = part.back ? Segment{line.b, line.a} : line;
    const double length = distance(line.a, line.b);
    const double gaps = std::max(1.0, std::round(part.whole / kPeriodMm));
    const double half = 0.5 * std::min(kGapMm / part.whole, kMostOfLine / gaps);
    // As shares of the whole fold; on the line, of the line.
    const double first = part.before / part.whole;
    const double share = length / part.whole;
    std::vector<Segment> scored;
    double from = 0.0;
    const auto score_to = [&](double to) {
        if ((to - from) * length <= kScoresNothingMm) return false;
        scored.push_back({lerp(along.a, along.b, from), lerp(along.a, along.b, to)});
        return true;
    };
    for (double i = std::floor(first * gaps); i < gaps && i < std::ceil((first + share) * gaps); ++i) {
        const double middle = (i + 0.5) / gaps;
        const double begin = (middle - half - first) / share;
        const double end = (middle + half - first) / share;
        if (end <= from || begin >= 1.0) continue;
        score_to(begin);
        from = std::min(end, 1.0);
    }
    if (score_to(1.0)) scored.back().b = along.b;
    return scored;
}

std::vector<Segment> broken_score(const Segment& line) {
    return broken_score(line, {0.0, distance(line.a, line.b), false});
}

}  // namespace popup
