#include "folded/straighten.h"

#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "base/nth.h"
#include "folded/least_step.h"
#include "folded/sine.h"

namespace popup::folded {
namespace {

constexpr double kNearlyStraight = 2e-3;  // radians
constexpr double kMovedMm = 1e-6;         // what moved by less is not counted
constexpr double kRegular = 1e-12;        // lines of a grid depend on each other nearly
constexpr int kSteps = 5;

// A corner between two others on one line.
struct Between {
    int at, from, to;
};

// A corner whose angles, taken in turn as plus and minus, add up to nought but for rounding (Kawasaki's
// theorem): it can be folded flat. Where its folds lead, in order around it.
struct FlatCorner {
    int at = 0;
    std::vector<int> to;
    double length = 0.0;  // mm, of the shortest fold
};

struct Way {
    double angle = 0.0;  // of `dir`, in (-π, π]
    Vec2 dir;
    std::size_t number = 0;
};

// Calls back with the numbers i < k of any two that lead nearly in opposite directions.
template <typename Use>
void each_opposite(std::vector<Way>& ways, const Use& use) {
    constexpr double kReach = 1.1 * kNearlyStraight;
    std::sort(ways.begin(), ways.end(), [](const Way& a, const Way& b) { return a.angle < b.angle; });
    for (const Way& one : ways) {
        // Half a turn on, as the angle that is greater; the other of the two finds this one.
        const double across = one.angle + std::numbers::pi;
        auto at = std::lower_bound(ways.begin(), ways.end(), across - kReach,
                                   [](const Way& way, double angle) { return way.angle < angle; });
        for (; at != ways.end() && at->angle <= across + kReach; ++at) {
            if (dot(one.dir, at->dir) < 0.0 && std::abs(cross(one.dir, at->dir)) < kNearlyStraight)
                use(std::min(one.number, at->number), std::max(one.number, at->number));
        }
    }
}

std::vector<Between> nearly_straight(const Sheet& sheet) {
    std::vector<std::vector<int>> ends(sheet.corners.size());  // by corner: where its folds lead
    for (const Fold& fold : sheet.folds) {
        for (const Stretch one : fold.stretches) {
            nth(ends, one.a).push_back(one.b);
            nth(ends, one.b).push_back(one.a);
        }
    }
    std::vector<Between> found;
    for (std::size_t corner = 0; corner < ends.size(); ++corner) {
        const std::vector<int>& there = ends[corner];
        const Vec2 at = sheet.corners[corner];
        std::vector<Way> ways;
        for (std::size_t i = 0; i < there.size(); ++i) {
            const Vec2 dir = unit(sheet.at(there[i]) - at);
            ways.push_back({std::atan2(dir.y, dir.x), dir, i});
        }
        std::vector<std::array<std::size_t, 2>> opposite;
        each_opposite(ways, [&](std::size_t i, std::size_t k) { opposite.push_back({i, k}); });
        std::sort(opposite.begin(), opposite.end());
        for (const auto& [i, k] : opposite) found.push_back({static_cast<int>(corner), there[i], there[k]});
    }
    return found;
}

double direction(Vec2 way) { return angle_of(way.y, way.x); }

// Half of the sum of Kawasaki's theorem: the directions, taken in turn as plus and minus; within a quarter
// turn of nought, as half turns do not count.
double out_of_flat(const std::vector<Vec2>& corners, const FlatCorner& one) {
    double sum = 0.0;
    for (std::size_t i = 0; i < one.to.size(); ++i)
        sum += (i % 2 == 0 ? 1.0 : -1.0) * direction(nth(corners, one.to[i]) - nth(corners, one.at));
    return std::remainder(sum, std::numbers::pi);
}

std::vector<FlatCorner> nearly_flat(const Sheet& sheet) {
    std::vector<FlatCorner> found;
    for (const Loop& loop : sheet.loops) {
        if (!loop.corner || loop.steps.size() < 4 || loop.steps.size() % 2 != 0) continue;
        FlatCorner one;
        one.at = loop.corner_number;
        one.length = HUGE_VAL;
        for (const Step& step : loop.steps) {
            for (const Stretch stretch : nth(sheet.folds, step.fold).stretches) {
                if (stretch.a != one.at && stretch.b != one.at) continue;
                one.to.push_back(stretch.a == one.at ? stretch.b : stretch.a);
                one.length = std::min(one.length, distance(sheet.at(one.to.back()), sheet.at(one.at)));
            }
        }
        if (one.to.size() == loop.steps.size() && std::abs(out_of_flat(sheet.corners, one)) < kNearlyStraight)
            found.push_back(std::move(one));
    }
    return found;
}

}  // namespace

Refined straighten(Sheet& sheet, double most_mm, Work& work) {
    Refined result;
    const std::vector<Between> lines = nearly_straight(sheet);
    const std::vector<FlatCorner> flat = nearly_flat(sheet);
    if (lines.empty() && flat.empty()) return result;
    std::vector<Vec2> corners = sheet.corners;
    const auto rows = static_cast<Eigen::Index>(lines.size() + flat.size());
    Eigen::VectorXd off(rows);
    std::vector<Eigen::Triplet<double>> entries;
    LeastStep least;
    for (int step = 0; step < kSteps; ++step) {
        entries.clear();
        for (std::size_t i = 0; i < lines.size(); ++i) {
            const auto row = static_cast<int>(i);
            const auto [at, from, to] = lines[i];
            const Vec2 way = nth(corners, to) - nth(corners, from);
            const Vec2 across = left_of(unit(way));
            const Vec2 here = nth(corners, at) - nth(corners, from);
            const double share = dot(here, way) / dot(way, way);
            off[row] = dot(across, here);
            const auto enter = [&](int corner, double by) {
                entries.emplace_back(row, 2 * corner, by * across.x);
                entries.emplace_back(row, 2 * corner + 1, by * across.y);
            };
            enter(at, 1.0);
            enter(from, share - 1.0);
            enter(to, -share);
        }
        for (std::size_t i = 0; i < flat.size(); ++i) {
            const auto row = static_cast<int>(lines.size() + i);
            const FlatCorner& one = flat[i];
            off[row] = one.length * out_of_flat(corners, one);
            for (std::size_t k = 0; k < one.to.size(); ++k) {
                const Vec2 way = nth(corners, one.to[k]) - nth(corners, one.at);
                // By how much the direction follows its end, across.
                const Vec2 by = ((k % 2 == 0 ? 1.0 : -1.0) * one.length / dot(way, way)) * left_of(way);
                entries.emplace_back(row, 2 * one.to[k], by.x);
                entries.emplace_back(row, 2 * one.to[k] + 1, by.y);
                entries.emplace_back(row, 2 * one.at, -by.x);
                entries.emplace_back(row, 2 * one.at + 1, -by.y);
            }
        }
        const auto unknowns = static_cast<Eigen::Index>(2 * corners.size());
        const std::optional<Eigen::VectorXd> by = least.find(entries, unknowns, off, kRegular, work);
        if (!by) return result;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const auto k = static_cast<Eigen::Index>(2 * i);
            corners[i] = corners[i] + Vec2{(*by)[k], (*by)[k + 1]};
        }
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const double by = distance(corners[i], sheet.corners[i]);
        if (by > kMovedMm) ++result.moved;
        if (by <= result.most_mm) continue;
        result.most_mm = by;
        result.corner = static_cast<int>(i);
    }
    result.closes = result.corner >= 0 && result.most_mm <= most_mm && keeps_panels(sheet, corners);
    if (result.closes) move_corners(sheet, std::move(corners));
    return result;
}

}  // namespace popup::folded
