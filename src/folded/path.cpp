#include "folded/path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numbers>
#include <numeric>
#include <optional>
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
constexpr std::size_t kFirstStride = 4;  // points of a range that are found first: every fourth
static_assert(kSteps % kFirstStride == 0);
constexpr double kLeastOpen = 1e-15;  // an error that is below rounding
// Shares at which the flat sheet is left, one after the other until there is closure.
constexpr std::array kFirstShares{0.1, 0.05, 0.2, 0.02, 0.35};
constexpr double kFirstWidth = 0.3;  // of a range
constexpr double kLeastWidth = 1.0 / 4096.0;
// What is left of a stage is taken at once if it is so many widths.
constexpr double kLastWidths = 1.5;
// Of a range: how wide the next one may be, how wide one that failed is tried again, and which share of what
// its error allows is taken.
constexpr double kWidest = 2.5;
constexpr double kNarrowest = 0.3;
constexpr double kLessWide = 0.85;
constexpr double kOfAllowed = 0.9;
constexpr double kOpenTimes = 0.5;
constexpr double kTimesStep = 1.0 / 64.0;
// A range is given up early if by what its first points say it would be open by so many times too much.
constexpr double kFarTooOpen = 30.0;
constexpr int kMostShorter = 3;  // times that a range is tried with less width before another way is
constexpr int kPaperHalvings = 24;
constexpr double kNearlyHalfTurn = 0.999 * std::numbers::pi;
constexpr double kOfPaper = 0.999;  // of the way to where a fold is turned by half a turn
constexpr int kMostStages = 12;
// Of a motion in which panels bend, which crawls where they crumple.
constexpr std::size_t kMostBentRanges = 100;
// Loops are closed to this at the points of a law, radians or shares of their size: far below what the law
// is held to between them, and above what rounding and flat states leave.
constexpr double kClosed = 5e-11;
// Of panels that bend: of the first range, and how much wider than one the next may be. The angles at which
// they do turn as the motion goes, and what fails costs more than one range more.
constexpr double kFirstBentWidth = 0.15;
constexpr double kWidestBent = 1.2;
// Steps to a singular point halve how far it is, and leave a quarter of what is open. So many that do, each
// to this share, lead there.
constexpr int kHalvingSteps = 3;
constexpr double kHalves = 0.02;
// Steps that do not bring what is open down to this share lead nowhere.
constexpr std::size_t kStuckSteps = 10;
constexpr double kNotNearer = 0.5;
// A fold that goes less than this share of its way the way it is drawn stays flat.
constexpr double kStays = 1e-3;
// One that goes more than this share of it the other way was not meant to.
constexpr double kOtherWay = 0.02;
// States whose angles differ by less are the same to the eye, radians.
constexpr double kBeside = 0.01;
// How near to what is asked for, one after the other until it is paper.
constexpr std::array kNearShares{1.0, 0.9999, 0.9995, 0.999, 0.995};
// Folds that are asked for are there, radians; by so much each turn comes nearer, and so many turns are
// taken.
constexpr double kThereRad = 1e-9;
constexpr double kComesNearer = 0.98;
constexpr int kMostTurns = 200;
// Paper is not folded by more than half a turn, but for rounding.
constexpr double kHalfTurn = std::numbers::pi + 1e-9;

// A range of shares with the angles at its Chebyshev points.
struct Range {
    double from = 0.0, to = 0.0;
    std::vector<Angles> points;
    [[nodiscard]] double share(std::size_t i) const {
        return i == kSteps ? to : from + (to - from) * chebyshev_share(i);
    }
    // By the barycentric formula, from every `stride`th point.
    [[nodiscard]] Angles between(double share_here, std::size_t stride = 1) const {
        for (std::size_t i = 0; i <= kSteps; i += stride) {
            if (share_here == share(i)) return points[i];
        }
        Angles above = Angles::Zero(points.front().size());
        double below = 0.0;
        for (std::size_t i = 0; i <= kSteps; i += stride) {
            const double weight = (i / stride % 2 == 0 ? 1.0 : -1.0) * (i == 0 || i == kSteps ? 0.5 : 1.0) /
                                  (share_here - share(i));
            above += weight * points[i];
            below += weight;
        }
        return above / below;
    }
};

// How it went with a range.
struct Tried {
    bool added = false;
    // Of one that was not: whether it would be with less width. Else its loops do not close.
    bool too_wide = false;
    double times = kOpenTimes;  // its width: what is tried next
    int loop = -1;              // of one that was not: which loop is open there, or would be
    // Of one that is too wide, at which points its loops are closed: every `stride`th. 0: at none.
    std::size_t stride = 0;
    Range range;
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
            const std::size_t left = ranges_.size();
            const double begin = reached;
            reached = go_on(begin, stages);
            if (reached == stages) end_nearest(begin, stages, left);
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
        // The largest share from which steps lead back. Beside a singular point what is open is as good as
        // quadratic, so that those from less go the same way, on a smaller scale.
        double back = 0.0;
        Angles there;
        for (const double one : kFirstShares) {
            if (one < back) continue;
            Angles here = from + one * (target_ - from);
            bool leads_back = false;
            const bool closes = come_near(here, from, one, leads_back) <= kClosed;
            if (leads_back) back = one;
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

    // Gives up what does not come nearer, and what comes to where nothing moves: a singular point, to which
    // it would be many steps yet.
    double come_near(Angles& here, const Angles& from, double share, bool& leads_back) {
        std::array<double, kStuckSteps> open{};
        std::size_t step = 0;
        double away = 0.0;
        double last = 0.0;
        int halved = 0;
        return closure_.approach(here, Closure::kRounding, [&](const Angles& there, double residual) {
            double& before = open.at(step++ % kStuckSteps);
            const bool stuck = step > kStuckSteps && residual > kNotNearer * before;
            before = residual;
            const double still = (there - from).lpNorm<Eigen::Infinity>();
            const bool halves = std::abs(still - 0.5 * away) < kHalves * away &&
                                std::abs(residual - 0.25 * last) < kHalves * last;
            halved = halves ? halved + 1 : 0;
            away = still;
            last = residual;
            // Where panels bend a way may part from that to the flat sheet late.
            leads_back = halved >= kHalvingSteps && !closure_.has_bends();
            return stuck || leads_back || stays_at(from, share, there);
        });
    }

    // From the last angles to the goal, at the share `end`. Returns how far it gets.
    double go_on(double share, double end) {
        const bool bends = closure_.has_bends();
        double width = bends ? kFirstBentWidth : kFirstWidth;
        bool straight = !bends;  // led on last
        int failed = 0;
        Tried before;  // what was too wide from here
        while (share < end) {
            const bool takes_rest = share + (failed == 0 ? kLastWidths : 1.0) * width >= end;
            const double to = takes_rest ? end : share + width;
            const Angles from = ranges_.back().points.back();
            const double begin = share;
            // Straight to the goal where that is near enough to closure all the way, for it ends there; else
            // along what keeps the loops closed, to the first order. What led on before is tried first, but
            // the last range is to end at the goal.
            const auto go = [&](bool straight_on) {
                const Angles way =
                    straight_on ? Angles(goal_ - from) : closure_.along_loops(from, goal_ - from);
                return try_range(begin, to, from, [&](double s) -> Angles {
                    return from + ((s - begin) / (end - begin)) * way;
                });
            };
            bool way = straight || to == end;
            Tried tried = before.stride > 0 ? try_less(before, to) : go(way);
            if (!tried.added && failed == 0 && is_turned_out(share, end, from)) break;
            const bool ends_here = tried.times * (to - share) < kLeastWidth;
            if (!tried.added && (!tried.too_wide || ends_here || failed >= kMostShorter)) {
                Tried other = go(!way);
                if (other.added || other.times > tried.times) {
                    tried = std::move(other);
                    way = !way;
                }
            }
            width = tried.times * (to - share);
            if (tried.added) {
                straight = way;
                share = to;
                failed = 0;
                before = {};
                if (bends && ranges_.size() >= kMostBentRanges) break;
            } else {
                cluster_.worst_loop = tried.loop;
                ++failed;
                if (width < kLeastWidth) break;
                if (tried.too_wide) straight = way;
                before = std::move(tried);
            }
        }
        return share;
    }

    // A way may end beside the state that is nearest to what is asked for. Then the stage goes to that one,
    // from where it has left: after the range of this number.
    void end_nearest(double share, double end, std::size_t left) {
        const Angles found = ranges_.back().points.back();
        Angles nearest = found;
        if (closure_.has_bends()) {
            closure_.draw_near(nearest, target_);
        } else if ((target_.array() != 0.0).all()) {
            come_near_target(nearest);
        } else if (!give_way(nearest)) {
            return;
        }
        if ((nearest - found).lpNorm<Eigen::Infinity>() < kBeside || !is_paper(nearest)) return;
        const auto after = ranges_.begin() + static_cast<std::ptrdiff_t>(left);
        std::vector<Range> before(std::make_move_iterator(after), std::make_move_iterator(ranges_.end()));
        ranges_.resize(left);
        goal_ = nearest;
        if (go_on(share, end) == end) return;
        ranges_.resize(left);
        std::move(before.begin(), before.end(), std::back_inserter(ranges_));
    }

    // Where all folds are asked for and go that way: as near as closure allows. Beside paper that is folded
    // flat, which rounding keeps from closing, the nearest state may turn a fold by a little more than half a
    // turn.
    void come_near_target(Angles& angles) {
        const Angles from = angles;
        if ((target_ - from).lpNorm<Eigen::Infinity>() < kBeside) return;
        if ((from.array() * target_.array() < 0.0).any()) return;
        for (const double share : kNearShares) {
            angles = from;
            closure_.draw_near(angles, share * target_);
            if (is_paper(angles)) return;
        }
        angles = from;
    }

    // Closing the loops takes from folds that are asked for and gives to those that are not. Lets the others
    // do it alone, by turns: what is asked for is set, and the loops are closed. False where they do not come
    // together.
    bool give_way(Angles& angles) {
        if ((target_.array() == 0.0).all() || (target_.array() != 0.0).all()) return false;
        double off = 0.0;
        for (int turn = 0; turn < kMostTurns; ++turn) {
            const double before = off;
            off = 0.0;
            for (Eigen::Index i = 0; i < target_.size(); ++i) {
                if (target_[i] == 0.0) continue;
                off = std::max(off, std::abs(target_[i] - angles[i]));
                angles[i] = target_[i];
            }
            if (turn > 0 && off > kComesNearer * before) return false;
            if (closure_.approach(angles, Closure::kRounding) > kClosed || !is_paper(angles)) return false;
            if (off < kThereRad) return true;
        }
        return false;
    }

    // Whether the way on turns a fold out of paper at once, for the loops to stay closed.
    bool is_turned_out(double share, double end, const Angles& from) {
        if (from.lpNorm<Eigen::Infinity>() < kNearlyHalfTurn) return false;
        const Angles by = (kLeastWidth / (end - share)) * closure_.along_loops(from, goal_ - from);
        const Angles beyond = from + by;
        if (is_paper(beyond)) return false;
        cluster_.worst_loop = does_not_close(on_paper(beyond)).loop;
        return true;
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
            if (try_range(share, ends.back(), here, guess).added) {
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

    // Closes the loops at every fourth point from what is guessed there, and at those between from what the
    // others say of them: so few points have a long way, and all are on one smooth curve.
    template <typename Guess>
    Tried try_range(double from, double to, const Angles& begin, const Guess& guess) {
        Range range;
        range.from = from;
        range.to = to;
        range.points.assign(kSteps + 1, begin);
        double open_before = 0.0;
        for (std::size_t stride = kFirstStride; stride > 0; stride /= 2) {
            const bool is_first = stride == kFirstStride;
            std::vector<std::size_t> numbers;
            std::vector<Angles> moving;
            for (std::size_t i = stride; i <= kSteps; i += is_first ? stride : 2 * stride) {
                numbers.push_back(i);
                moving.push_back(is_first ? guess(range.share(i))
                                          : range.between(range.share(i), 2 * stride));
            }
            if (!is_first) {
                // Errors fall as powers of the number of points.
                int loop = -1;
                const double open = closure_.residual(moving.front(), &loop);
                const double ratio = std::min(1.0, open / std::max(open_before, kLeastOpen));
                if (stride == 1 && open * ratio * ratio > kFarTooOpen * most_)
                    return too_wide(open * ratio * ratio, loop, std::move(range), 2);
                open_before = open;
            }
            if (const int open = closure_.approach_smoothly(moving, kClosed, !is_first); open >= 0)
                return does_not_close(nth(moving, open));
            for (std::size_t i = 0; i < numbers.size(); ++i) range.points[numbers[i]] = std::move(moving[i]);
            if (std::optional<Tried> beyond = leaves_paper(range, stride)) return *std::move(beyond);
        }
        return check_between(std::move(range));
    }

    // A first part of what was too wide, whose points say nearly where those of the part are.
    Tried try_less(const Tried& wide, double to) {
        Range range;
        range.from = wide.range.from;
        range.to = to;
        range.points.assign(1, wide.range.points.front());
        for (std::size_t i = 1; i <= kSteps; ++i)
            range.points.push_back(wide.range.between(range.share(i), wide.stride));
        if (const int open = closure_.approach_smoothly(std::span(range.points).subspan(1), kClosed, true);
            open >= 0)
            return does_not_close(nth(range.points, open + 1));
        if (std::optional<Tried> beyond = leaves_paper(range, 1)) return *std::move(beyond);
        return check_between(std::move(range));
    }

    // Between its points, where a polynomial departs furthest.
    Tried check_between(Range range) {
        double open = -1.0;
        int most_open = -1;
        for (std::size_t i = 0; i < kSteps; ++i) {
            const double middle = 0.5 * (range.share(i) + range.share(i + 1));
            const Angles there = range.between(middle);
            int loop = -1;
            const double here = closure_.residual(there, &loop);
            if (!(here <= kFarTooOpen * most_)) return too_wide(here, loop, std::move(range), 1);
            if (!is_paper(there)) return ends_between(range, 1, range.share(i), middle, there);
            if (here <= open) continue;
            open = here;
            most_open = loop;
        }
        if (open > most_) return too_wide(open, most_open, std::move(range), 1);
        ranges_.push_back(std::move(range));
        const double widest = closure_.has_bends() ? kWidestBent : kWidest;
        return {true, false, allowed_times(open, widest), -1, 0, {}};
    }

    // The width that the error allows, in whole steps; the error grows with a power of it. That is multiplied
    // out, because roots differ in the last bit between processors.
    [[nodiscard]] double allowed_times(double open, double most) const {
        const auto is_allowed = [&](double times) {
            double there = std::max(open, kLeastOpen);
            for (std::size_t i = 0; i <= kSteps; ++i) there *= times / kOfAllowed;
            return there <= most_;
        };
        double steps = std::ceil(most / kTimesStep);
        while (steps * kTimesStep > kNarrowest && !is_allowed(steps * kTimesStep)) steps -= 1.0;
        return std::clamp(steps * kTimesStep, kNarrowest, most);
    }
    [[nodiscard]] Tried too_wide(double open, int loop, Range range, std::size_t stride) const {
        return {false, true, allowed_times(open, kLessWide), loop, stride, std::move(range)};
    }

    // If a fold is turned by more than half a turn at a point: up to where none is.
    [[nodiscard]] std::optional<Tried> leaves_paper(const Range& range, std::size_t stride) {
        std::size_t last = stride;
        while (last <= kSteps && is_paper(range.points[last])) last += stride;
        if (last > kSteps) return std::nullopt;
        return ends_between(range, stride, range.share(last - stride), range.share(last), range.points[last]);
    }

    // No fold is turned by more than half a turn at `low`, one is at `high`, where the angles are these. Then
    // the loops close there, and what is open is what would be if paper were folded no further.
    Tried ends_between(const Range& range, std::size_t stride, double low, double high,
                       const Angles& beyond) {
        for (int i = 0; i < kPaperHalvings; ++i) {
            const double middle = 0.5 * (low + high);
            (is_paper(range.between(middle, stride)) ? low : high) = middle;
        }
        Tried tried = does_not_close(on_paper(beyond));
        tried.too_wide = true;
        tried.times = kOfPaper * (low - range.from) / (range.to - range.from);
        return tried;
    }

    static Angles on_paper(const Angles& angles) {
        return angles.cwiseMax(-std::numbers::pi).cwiseMin(std::numbers::pi);
    }
    static bool is_paper(const Angles& angles) { return angles.lpNorm<Eigen::Infinity>() <= kHalfTurn; }

    Tried does_not_close(const Angles& angles) {
        Tried tried;
        closure_.residual(angles, &tried.loop);
        return tried;
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

bool Paths::any_jumps() const {
    return std::any_of(clusters.begin(), clusters.end(),
                       [](const Cluster& one) { return one.jumps_from >= 0.0; });
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
