#include "fabrication/shared_lines.h"

#include <algorithm>
#include <utility>

namespace popup {
namespace {

// A path that lies on itself for no more than this is not drawn twice: fine steps and sharp corners do so.
constexpr double kOwnMm = 10.0 * kSharedMm;

// The part of `line` that lies along `taken`, as a range of its length; false when there is none to speak of.
bool covered(const Segment& line, const Segment& taken, std::pair<double, double>& range) {
    const double length = distance(line.a, line.b);
    if (distance(line.a, taken) <= kSharedMm && distance(line.b, taken) <= kSharedMm) {
        range = {0.0, length};
        return true;
    }
    if (length <= kSharedMm) return false;
    const Vec2 unit = (1.0 / length) * (line.b - line.a);
    range = std::minmax({dot(taken.a - line.a, unit), dot(taken.b - line.a, unit)});
    range = {std::max(range.first, 0.0), std::min(range.second, length)};
    return range.second - range.first > kSharedMm &&
           distance(line.a + range.first * unit, taken) <= kSharedMm &&
           distance(line.a + range.second * unit, taken) <= kSharedMm;
}

// The ranges of a line that are not covered.
std::vector<std::pair<double, double>> free_ranges(std::vector<std::pair<double, double>> taken,
                                                   double length) {
    std::sort(taken.begin(), taken.end());
    std::vector<std::pair<double, double>> free;
    double at = 0.0;
    for (const auto& [first, last] : taken) {
        if (first - at > kSharedMm) free.emplace_back(at, first);
        at = std::max(at, last);
    }
    if (length - at > kSharedMm) free.emplace_back(at, length);
    return free;
}

}  // namespace

std::vector<PathPart> SharedLines::left_of(std::span<const Vec2> points, bool closed) {
    const int first_own = taken_.size();
    std::vector<PathPart> parts;
    std::vector<Segment> own;
    const std::size_t n = points.size();
    for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i) own.push_back({points[i], points[(i + 1) % n]});
    bool whole = true;
    std::vector<int> near;
    std::vector<std::pair<double, double>> taken;
    // Only what is drawn counts as taken: of many lines close to each other not each takes the next away. It
    // does at once: a line may run back on itself.
    const auto add = [&](Vec2 a, Vec2 b) {
        taken_.insert({a, b}, false);
        if (!parts.empty() && parts.back().points.back() == a) {
            parts.back().points.push_back(b);
        } else {
            parts.push_back({{a, b}, false});
        }
    };
    for (const Segment& line : own) {
        const Box box{{std::min(line.a.x, line.b.x) - kSharedMm, std::min(line.a.y, line.b.y) - kSharedMm},
                      {std::max(line.a.x, line.b.x) + kSharedMm, std::max(line.a.y, line.b.y) + kSharedMm}};
        near.clear();
        taken_.query(box, near);
        taken.clear();
        for (const int number : near) {
            std::pair<double, double> range;
            if (!covered(line, taken_[number], range)) continue;
            if (number < first_own || range.second - range.first > kOwnMm) taken.push_back(range);
        }
        if (taken.empty()) {
            add(line.a, line.b);
            continue;
        }
        whole = false;
        const double length = distance(line.a, line.b);
        for (const auto& [first, last] : free_ranges(taken, length)) {
            const auto at = [&](double place) {
                if (place <= 0.0) return line.a;
                if (place >= length) return line.b;
                return line.a + (place / length) * (line.b - line.a);
            };
            add(at(first), at(last));
        }
    }
    if (whole) return {{{points.begin(), points.end()}, closed}};
    // What goes on round the corner where the contour begins is one part.
    if (closed && parts.size() > 1 && parts.back().points.back() == parts.front().points.front()) {
        std::vector<Vec2>& last = parts.back().points;
        last.insert(last.end(), parts.front().points.begin() + 1, parts.front().points.end());
        std::swap(parts.front(), parts.back());
        parts.pop_back();
    }
    return parts;
}

}  // namespace popup
