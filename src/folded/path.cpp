#include "folded/path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
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
constexpr int kMostStages = 12;
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
    Walk(const Sheet& sheet, const PathOptions& options, Cluster& cluster, Work& work)
        : cluster_(cluster),
          work_(work),
          closure_(sheet, cluster.folds, cluster.loops, work),
          target_(static_cast<Eigen::Index>(cluster.folds.size())) {
        for (std::size_t i = 0; i < cluster.folds.size(); ++i)
            target_[static_cast<Eigen::Index>(i)] = nth(sheet.folds, cluster.folds[i]).target;
        // The two ways around many loops differ by the sum of these, and that turns the whole sheet.
        const double lever = sheet.size() * std::sqrt(static_cast<double>(cluster.loops.size()));
        most_ = std::max(options.closure_mm / lever, 4.0 * kClosed);
    }

    // Folds that cannot go together go one after another: what stays as it is in one stage may leave in the
    // next, when others are folded flat. Each stage takes as much of the motion as any other.
    std::vector<Range> run() {
        if (!closure_.is_affordable()) {
            cluster_.given_up = true;
            cluster_.reached = 0.0;
            cluster_.worst_loop = cluster_.loops.front();
            return {};
        }
        Angles here = Angles::Zero(target_.size());
        double reached = 0.0;
        int stages = 0;
        bool all_there = false;
        while (stages < kMostStages && reached == stages && !all_there) {
            if (!leave(reached, here)) break;
            ++stages;
            reached = go_on(reached, stages);
            here = ranges_.back().points.back();
            all_there = !any_stays(here);
        }
        cluster_.given_up = work_.is_spent() && (stages == 0 || reached < stages || !all_there);
        if (stages == 0) return stays();
        for (Range& range : ranges_) {
            range.from /= stages;
            range.to /= stages;
        }
        cluster_.reached = reached / stages;
        cluster_.all_fold = all_there;
        return std::move(ranges_);
    }

 private:
    // Nothing is folded. What stays open is measured half way, with each fold at its share.
    std::vector<Range> stays() {
        cluster_.reached = 0.0;
        cluster_.residual = closure_.residual(0.5 * target_, &cluster_.worst_loop);
        return {};
    }

    // From angles at which the loops are closed, but where many ways may lead on, to those at some share
    // beyond. In between the angles change in proportion.
    bool leave(double& share, const Angles& from) {
        goal_ = target_;
        bool found = false;
        double first = 0.0;
        Angles there;
        for (const double one : kFirstShares) {
            Angles here = from + one * (target_ - from);
            const bool closes = closure_.approach(here) <= kClosed;
            // Where panels bend many ways lead on.
            if (closes && closure_.has_bends()) closure_.draw_near(here, from + one * (target_ - from));
            if (!closes || stays_at(from, one, here) || !is_paper(here)) continue;
            const bool other_way = goes_other_way(from, one, here);
            if (found && other_way) continue;
            found = true;
            first = one;
            there = here;
            cluster_.other_way = other_way;
            if (!other_way) break;
        }
        if (!found) return false;
        const double begin = share;
        const auto towards = [&](double s) -> Angles {
            return from + ((s - begin) / first) * (there - from);
        };
        if (!add(begin, begin + first, from, towards)) return false;
        share += first;
        for (Eigen::Index i = 0; i < goal_.size(); ++i) {
            if (target_[i] == 0.0) goal_[i] = from[i] + (there[i] - from[i]) / first;
        }
        return true;
    }

    // From the last angles to the goal, at the share `end`. Returns how far it gets.
    double go_on(double share, double end) {
        double width = kFirstWidth;
        bool straight = true;  // led on last
        while (share < end) {
            const double to = share + 1.5 * width >= end ? end : share + width;
            const Angles from = ranges_.back().points.back();
            const double begin = share;
            // Straight to the goal where that is near enough to closure all the way, for it ends there; else
            // along what keeps the loops closed, to the first order. What led on before is tried first, but
            // the last range is to end at the goal.
            const auto go = [&](bool straight_on) {
                const Angles way =
                    straight_on ? Angles(goal_ - from) : closure_.along_loops(from, goal_ - from);
                return add_range(begin, to, from, [&](double s) -> Angles {
                    return from + ((s - begin) / (end - begin)) * way;
                });
            };
            const bool first = straight || to == end;
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
        return share;
    }

    [[nodiscard]] bool goes_other_way(const Angles& from, double share, const Angles& angles) const {
        for (Eigen::Index i = 0; i < angles.size(); ++i) {
            const double way = target_[i] - from[i];
            if ((angles[i] - from[i]) * way < -kOtherWay * share * way * way) return true;
        }
        return false;
    }

    // Closure may have been found where nothing moves.
    [[nodiscard]] bool stays_at(const Angles& from, double share, const Angles& angles) const {
        return (angles - from).lpNorm<Eigen::Infinity>() < kStays * share * target_.lpNorm<Eigen::Infinity>();
    }

    // Whether a fold has not left the flat sheet yet.
    [[nodiscard]] bool any_stays(const Angles& angles) const {
        for (Eigen::Index i = 0; i < angles.size(); ++i) {
            if (std::abs(angles[i]) < kStays * std::abs(target_[i])) return true;
        }
        return false;
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
    Work& work_;
    double most_ = 0.0;  // residual between the points of a law
    Closure closure_;
    Angles target_;
    Angles goal_;  // of the stage
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

bool Paths::any_given_up() const {
    return std::any_of(clusters.begin(), clusters.end(), [](const Cluster& one) { return one.given_up; });
}

Paths find_paths(const Sheet& sheet, const PathOptions& options, Work& work) {
    Paths paths;
    paths.laws.resize(sheet.folds.size());
    for (std::size_t i = 0; i < sheet.folds.size(); ++i)
        paths.laws[i] = {{0.0, 0.0}, {1.0, sheet.folds[i].target}};
    paths.clusters = find_clusters(sheet);
    std::vector<std::size_t> order(paths.clusters.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return paths.clusters[a].loops.size() < paths.clusters[b].loops.size();
    });
    for (const std::size_t number : order) {
        Cluster& cluster = paths.clusters[number];
        const std::vector<Range> ranges = Walk(sheet, options, cluster, work).run();
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
