#include "folded/carton/follow_lines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

#include "base/nth.h"

namespace popup::folded {
namespace {

constexpr double kOnStretchMm = 0.01;
constexpr double kStandsStillMm = 1e-7;  // corners that move by less stand still
constexpr double kSnapMm = 0.5;          // as FoldOptions has it
constexpr double kSnapShare = 1.0 / 400.0;

class Follower {
 public:
    Follower(const CreasePattern& pattern, const FoldOptions& options, const Sheet& before,
             const Sheet& after)
        : pattern_(pattern), before_(before), after_(after) {
        reach_ = options.snap_mm.value_or(std::max(kSnapMm, kSnapShare * before.size()));
        for (std::size_t i = 0; i < before.corners.size(); ++i) by_x_.push_back(static_cast<int>(i));
        std::sort(by_x_.begin(), by_x_.end(),
                  [&](int a, int b) { return std::pair(before.at(a).x, a) < std::pair(before.at(b).x, b); });
        fold_at_.resize(before.corners.size());
        for (const Fold& fold : before.folds) {
            for (const Stretch& one : fold.stretches) {
                nth(fold_at_, one.a).push_back(fold.line);
                nth(fold_at_, one.b).push_back(fold.line);
            }
        }
    }

    EditedSheet run() {
        EditedSheet made;
        for (std::size_t i = 0; i < pattern_.lines.size(); ++i)
            made.lines.push_back(follow(static_cast<int>(i)));
        for (std::size_t i = 0; i < before_.corners.size(); ++i) {
            const double by = distance(before_.corners[i], after_.corners[i]);
            if (by > kStandsStillMm) ++made.moved_corners;
            made.most_mm = std::max(made.most_mm, by);
        }
        return made;
    }

 private:
    EditedSheet::Line follow(int number) {
        const CreaseLine& line = nth(pattern_.lines, number);
        EditedSheet::Line made;
        bool parted = false;
        for (const Vec2 p : line.points) {
            const auto [to, one_place] = moved(number, line, p);
            parted = parted || !one_place;
            made.moved = made.moved || distance(p, to) > kStandsStillMm;
            made.points.push_back(to);
        }
        const std::size_t stretches = line.points.size() - (line.closed ? 0 : 1);
        for (std::size_t i = 0; i < stretches && !parted; ++i) {
            const std::size_t next = (i + 1) % line.points.size();
            parted = !go_through(number, static_cast<int>(i), {line.points[i], line.points[next]},
                                 {made.points[i], made.points[next]}, made);
        }
        if (parted) {
            made.moved = true;
            made.through.clear();
            made.parted = edges_of(line);
        }
        if (!made.moved) made.points = line.points;
        return made;
    }

    // Corners that lay on a stretch of a line, and leave it; false: what lies on its two sides goes apart.
    bool go_through(int number, int stretch, Segment was, Segment is, EditedSheet::Line& made) const {
        const Vec2 way = was.b - was.a;
        const double size = dot(way, way);
        if (size <= 0.0) return true;
        const double low = std::min(was.a.x, was.b.x) - kOnStretchMm;
        const double high = std::max(was.a.x, was.b.x) + kOnStretchMm;
        const double ends = reach_ / std::sqrt(size);
        auto at = std::lower_bound(by_x_.begin(), by_x_.end(), low,
                                   [&](int corner, double x) { return before_.at(corner).x < x; });
        std::vector<std::tuple<double, Vec2, Vec2>> found;  // where on it, by how much, off the line
        for (; at != by_x_.end() && before_.at(*at).x <= high; ++at) {
            const Vec2 p = before_.at(*at);
            const double t = dot(p - was.a, way) / size;
            if (t <= ends || t >= 1.0 - ends || distance(p, lerp(was.a, was.b, t)) > kOnStretchMm) continue;
            const auto [to, one_place] = moved(number, nth(pattern_.lines, number), p);
            if (!one_place) return false;
            found.emplace_back(t, to, to - lerp(is.a, is.b, t));
        }
        const bool leaves = std::any_of(found.begin(), found.end(), [&](const auto& one) {
            return std::abs(cross(std::get<2>(one), is.b - is.a)) >
                   kStandsStillMm * (1.0 + length(is.b - is.a));
        });
        if (!leaves) return true;
        std::sort(found.begin(), found.end(),
                  [](const auto& a, const auto& b) { return std::get<0>(a) < std::get<0>(b); });
        for (const auto& [t, to, off] : found) {
            if (!made.through.empty() && distance(made.through.back().second, to) <= kStandsStillMm) continue;
            made.through.emplace_back(stretch, to);
        }
        made.moved = true;
        return true;
    }

    // Where a point of a line goes, and whether that is one place.
    std::pair<Vec2, bool> moved(int number, const CreaseLine& line, Vec2 p) const {
        std::vector<std::pair<double, int>> near;
        auto at = std::lower_bound(by_x_.begin(), by_x_.end(), p.x - reach_,
                                   [&](int corner, double x) { return before_.at(corner).x < x; });
        for (; at != by_x_.end() && before_.at(*at).x <= p.x + reach_; ++at) {
            if (const double far = distance(p, before_.at(*at)); far <= reach_) near.emplace_back(far, *at);
        }
        if (near.empty()) return {p + along_edge(p), true};
        std::sort(near.begin(), near.end());
        constexpr double kSamePlace = 1e-6;
        std::erase_if(near, [&](const auto& one) { return one.first > near.front().first + kSamePlace; });
        const auto shift = [&](int corner) { return after_.at(corner) - before_.at(corner); };
        if (line.use != CreaseUse::cut) {
            for (const auto& [far, corner] : near) {
                const std::vector<int>& lines = nth(fold_at_, corner);
                if (std::find(lines.begin(), lines.end(), number) != lines.end())
                    return {p + shift(corner), true};
            }
        }
        const Vec2 first = shift(near.front().second);
        const bool one_place = std::all_of(near.begin(), near.end(), [&](const auto& one) {
            return length(shift(one.second) - first) <= kStandsStillMm;
        });
        return {p + first, one_place || line.use != CreaseUse::cut};
    }

    // Of a point in the middle of an edge, as one that is drawn over another: as the edge moves there.
    [[nodiscard]] Vec2 along_edge(Vec2 p) const {
        double nearest = reach_;
        Vec2 shift;
        const auto look = [&](const Stretch& one) {
            const Segment edge = before_.segment(one);
            const Vec2 way = edge.b - edge.a;
            const double size = dot(way, way);
            if (size <= 0.0) return;
            const double t = std::clamp(dot(p - edge.a, way) / size, 0.0, 1.0);
            const double far = distance(p, lerp(edge.a, edge.b, t));
            if (far > nearest) return;
            nearest = far;
            shift = lerp(after_.at(one.a) - edge.a, after_.at(one.b) - edge.b, t);
        };
        for (const std::vector<Stretch>& cuts : before_.cuts) std::for_each(cuts.begin(), cuts.end(), look);
        for (const Fold& fold : before_.folds)
            std::for_each(fold.stretches.begin(), fold.stretches.end(), look);
        return shift;
    }

    // All edges of panels, at their new places, that a line of cuts stood for.
    [[nodiscard]] std::vector<Segment> edges_of(const CreaseLine& line) const {
        std::vector<Segment> found;
        const std::size_t count = line.points.size() - (line.closed ? 0 : 1);
        for (const std::vector<Stretch>& cuts : before_.cuts) {
            for (const Stretch& cut : cuts) {
                const Segment edge = before_.segment(cut);
                const bool drawn = [&] {
                    for (std::size_t i = 0; i < count; ++i) {
                        const Segment drawn_line{line.points[i], line.points[(i + 1) % line.points.size()]};
                        if (lies_on(edge.a, drawn_line) && lies_on(edge.b, drawn_line)) return true;
                    }
                    return false;
                }();
                if (!drawn) continue;
                Segment made = after_.segment(cut);
                if (std::pair(made.b.x, made.b.y) < std::pair(made.a.x, made.a.y)) std::swap(made.a, made.b);
                found.push_back(made);
            }
        }
        // What lies on both sides of a slit that stays one.
        std::vector<Segment> once;
        for (const Segment& one : found) {
            const bool again = std::any_of(once.begin(), once.end(), [&](const Segment& other) {
                return distance(one.a, other.a) <= kStandsStillMm &&
                       distance(one.b, other.b) <= kStandsStillMm;
            });
            if (!again && distance(one.a, one.b) > kStandsStillMm) once.push_back(one);
        }
        return once;
    }
    [[nodiscard]] bool lies_on(Vec2 p, const Segment& line) const {
        const Vec2 way = line.b - line.a;
        const double size = dot(way, way);
        const double t = size > 0.0 ? std::clamp(dot(p - line.a, way) / size, 0.0, 1.0) : 0.0;
        return distance(p, lerp(line.a, line.b, t)) <= std::min(reach_, 0.05);
    }

    const CreasePattern& pattern_;
    const Sheet& before_;
    const Sheet& after_;
    double reach_ = 0.0;
    std::vector<int> by_x_;                  // corners
    std::vector<std::vector<int>> fold_at_;  // by corner: lines of folds
};

}  // namespace

EditedSheet follow_lines(const CreasePattern& pattern, const FoldOptions& options, const Sheet& before,
                         const Sheet& after) {
    return Follower(pattern, options, before, after).run();
}

}  // namespace popup::folded
