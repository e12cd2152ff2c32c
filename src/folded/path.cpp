#include "folded/path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "base/nth.h"
#include "base/sets.h"
#include "folded/closure.h"
#include "popup/joints.h"

namespace popup::folded {
namespace {

using Angles = Eigen::VectorXd;

constexpr std::size_t kSteps = Folded::kLawSteps;
// Shares at which the flat sheet is left, one after the other until there is closure.
constexpr std::array kFirstShares{0.1, 0.05, 0.2, 0.02, 0.35};
constexpr double kFirstWidth = 0.3;  // of a range
constexpr double kLeastWidth = 1.0 / 4096.0;
// Loops are closed to this at the points of a law, radians or shares of their size: far below what the law
// is held to between them, and above what rounding and flat states leave.
constexpr double kClosed = 5e-11;
// A fold that goes less than this share of its way the way it is drawn stays flat.
constexpr double kStays = 1e-3;
// One that goes more than this share of it the other way was not meant to.
constexpr double kOtherWay = 0.02;
// Paper is not folded by more than half a turn, but for rounding.
constexpr double kHalfTurn = std::numbers::pi + 1e-9;

// A range of shares with the angles at its Chebyshev points.
struct Range {
    double from = 0.0, to = 0.0;
    std::vector<Angles> points;
    [[nodiscard]] double share(std::size_t i) const {
        return i == kSteps ? to : from + (to - from) * chebyshev_share(i);
    }
    // By the barycentric formula; not at a point.
    [[nodiscard]] Angles between(double share_here) const {
        Angles above = Angles::Zero(points.front().size());
        double below = 0.0;
        for (std::size_t i = 0; i <= kSteps; ++i) {
            const double weight =
                (i % 2 == 0 ? 1.0 : -1.0) * (i == 0 || i == kSteps ? 0.5 : 1.0) / (share_here - share(i));
            above += weight * points[i];
            below += weight;
        }
        return above / below;
    }
};

class Walk {
 public:
    Walk(const Sheet& sheet, const PathOptions& options, Cluster& cluster)
        : cluster_(cluster),
          closure_(sheet, cluster.folds, cluster.loops),
          target_(static_cast<Eigen::Index>(cluster.folds.size())) {
        for (std::size_t i = 0; i < cluster.folds.size(); ++i)
            target_[static_cast<Eigen::Index>(i)] = nth(sheet.folds, cluster.folds[i]).target;
        // The two ways around many loops differ by the sum of these, and that turns the whole sheet.
        const double lever = sheet.size() * std::sqrt(static_cast<double>(cluster.loops.size()));
        most_ = std::max(options.closure_mm / lever, 4.0 * kClosed);
    }

    std::vector<Range> run() {
        Angles here;
        double share = 0.0;
        if (!leave(share, here)) return stays();
        // Between the flat sheet and the first share the angles shrink in proportion.
        const Angles first = here;
        const double first_share = share;
        const auto shrunk = [&](double s) -> Angles { return (s / first_share) * first; };
        if (!add(0.0, share, Angles::Zero(first.size()), shrunk)) return stays();
        Angles goal = target_;
        for (Eigen::Index i = 0; i < goal.size(); ++i) {
            if (target_[i] == 0.0) goal[i] = first[i] / first_share;
        }
        double width = kFirstWidth;
        bool straight = true;
        while (share < 1.0) {
            const double to = share + 1.5 * width >= 1.0 ? 1.0 : share + width;
            const Angles from = ranges_.back().points.back();
            const double begin = share;
            // Straight to the goal where that is near enough to closure all the way, for it ends there; else
            // along what keeps the loops closed, to the first order. What led on before is tried first, but
            // the last range is to end at the goal.
            const auto go = [&](bool straight) {
                const Angles way = straight ? Angles(goal - from) : closure_.along_loops(from, goal - from);
                return add_range(share, to, from, [&](double s) -> Angles {
                    return from + ((s - begin) / (1.0 - begin)) * way;
                });
            };
            const bool first = straight || to == 1.0;
            bool added = go(first);
            if (added) {
                straight = first;
            } else {
                added = go(!first);
                if (added) straight = !first;
            }
            if (added) {
                share = to;
                width *= 1.5;
                continue;
            }
            width = 0.5 * (to - share);
            if (width < kLeastWidth) break;
        }
        cluster_.reached = share;
        return std::move(ranges_);
    }

 private:
    // Nothing is folded. What stays open is measured half way, with each fold at its share.
    std::vector<Range> stays() {
        cluster_.reached = 0.0;
        cluster_.residual = closure_.residual(0.5 * target_, &cluster_.worst_loop);
        return {};
    }

    // From the flat sheet to the angles at some share.
    bool leave(double& share, Angles& here) {
        Angles other_way;
        for (const double first : kFirstShares) {
            here = first * target_;
            const bool closes = closure_.approach(here) <= kClosed;
            if (!closes || stays_flat(first, here) || !is_paper(here)) continue;
            if (goes_other_way(first, here)) {
                if (share == 0.0) {
                    share = first;
                    other_way = here;
                }
                continue;
            }
            share = first;
            return true;
        }
        cluster_.other_way = share > 0.0;
        here = other_way;
        return share > 0.0;
    }

    [[nodiscard]] bool goes_other_way(double share, const Angles& angles) const {
        for (Eigen::Index i = 0; i < angles.size(); ++i) {
            if (angles[i] * target_[i] < -kOtherWay * share * target_[i] * target_[i]) return true;
        }
        return false;
    }

    // Closure may have been found where nothing is folded.
    [[nodiscard]] bool stays_flat(double share, const Angles& angles) const {
        return angles.lpNorm<Eigen::Infinity>() < kStays * share * target_.lpNorm<Eigen::Infinity>();
    }

    // One range, or as many as it takes.
    template <typename Guess>
    bool add(double from, double to, const Angles& begin, const Guess& guess) {
        std::vector<double> ends{to};  // nearest last
        double share = from;
        Angles here = begin;
        while (!ends.empty()) {
            if (add_range(share, ends.back(), here, guess)) {
                share = ends.back();
                here = ranges_.back().points.back();
                ends.pop_back();
                continue;
            }
            if (ends.back() - share < kLeastWidth) return false;
            ends.push_back(0.5 * (share + ends.back()));
        }
        return true;
    }

    template <typename Guess>
    bool add_range(double from, double to, const Angles& begin, const Guess& guess) {
        Range range;
        range.from = from;
        range.to = to;
        range.points.assign(kSteps + 1, begin);
        for (std::size_t i = 1; i <= kSteps; ++i) range.points[i] = guess(range.share(i));
        const std::span<Angles> moving = std::span(range.points).subspan(1);
        if (const int open = closure_.approach_smoothly(moving, kClosed); open >= 0)
            return blame(moving[static_cast<std::size_t>(open)]);
        for (const Angles& there : moving) {
            if (!is_paper(there)) return blame(there);
        }
        // Between its points, where a polynomial departs furthest.
        for (std::size_t i = 0; i < kSteps; ++i) {
            const double share = 0.5 * (range.share(i) + range.share(i + 1));
            const Angles there = range.between(share);
            if (closure_.residual(there) <= most_ && is_paper(there)) continue;
            return blame(there);
        }
        ranges_.push_back(std::move(range));
        return true;
    }

    static bool is_paper(const Angles& angles) { return angles.lpNorm<Eigen::Infinity>() <= kHalfTurn; }

    // Keeps the loop that is furthest from closed there.
    bool blame(const Angles& angles) {
        closure_.residual(angles, &cluster_.worst_loop);
        return false;
    }

    Cluster& cluster_;
    double most_ = 0.0;  // residual between the points of a law
    Closure closure_;
    Angles target_;
    std::vector<Range> ranges_;
};

std::vector<Cluster> find_clusters(const Sheet& sheet) {
    Sets sets(sheet.folds.size());
    for (const Loop& loop : sheet.loops) {
        for (const Step& step : loop.steps) sets.unite(step.fold, loop.steps.front().fold);
    }
    std::vector<int> number(sheet.folds.size(), -1);
    std::vector<Cluster> clusters;
    for (std::size_t i = 0; i < sheet.loops.size(); ++i) {
        int& of = nth(number, sets.find(sheet.loops[i].steps.front().fold));
        if (of < 0) {
            of = static_cast<int>(clusters.size());
            clusters.emplace_back();
        }
        nth(clusters, of).loops.push_back(static_cast<int>(i));
    }
    for (std::size_t i = 0; i < sheet.folds.size(); ++i) {
        const int of = nth(number, sets.find(static_cast<int>(i)));
        if (of >= 0) nth(clusters, of).folds.push_back(static_cast<int>(i));
    }
    return clusters;
}

}  // namespace

double angle_at(const std::vector<SharePoint>& law, double share) {
    std::vector<Vec2> points;
    points.reserve(law.size());
    for (const SharePoint& one : law) points.push_back({one.share, one.angle});
    return fold_angle_deg(points, share);
}

Paths find_paths(const Sheet& sheet, const PathOptions& options) {
    Paths paths;
    paths.laws.resize(sheet.folds.size());
    for (std::size_t i = 0; i < sheet.folds.size(); ++i)
        paths.laws[i] = {{0.0, 0.0}, {1.0, sheet.folds[i].target}};
    paths.clusters = find_clusters(sheet);
    for (Cluster& cluster : paths.clusters) {
        const std::vector<Range> ranges = Walk(sheet, options, cluster).run();
        paths.reached = std::min(paths.reached, cluster.reached);
        if (ranges.empty()) {
            for (const int fold : cluster.folds) nth(paths.laws, fold) = {{0.0, 0.0}, {1.0, 0.0}};
            continue;
        }
        for (std::size_t k = 0; k < cluster.folds.size(); ++k) {
            std::vector<SharePoint>& law = nth(paths.laws, cluster.folds[k]);
            law.assign(1, {0.0, 0.0});
            for (const Range& range : ranges) {
                for (std::size_t i = 1; i <= kSteps; ++i)
                    law.push_back({range.share(i), range.points[i][static_cast<Eigen::Index>(k)]});
            }
        }
    }
    return paths;
}

}  // namespace popup::folded
