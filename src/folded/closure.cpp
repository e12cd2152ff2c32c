#include "folded/closure.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>
#include <vector>

#include "base/nth.h"

namespace popup::folded {
namespace {

// Added to the normal equations, whose entries are of the size of 1: this, and so many times the mean square
// of the residuals. Of loops that depend on each other most conditions are idle where all are closed, but not
// beside it, and there steps go wherever such a condition wants. With a damping of that order they are
// quadratically convergent nevertheless (Yamashita and Fukushima, On the rate of convergence of the
// Levenberg-Marquardt method, 2001).
constexpr double kRegular = 1e-13;
constexpr double kDamped = 10.0;
constexpr int kMostSteps = 60;
// As many for all, whether some have come to closure before or not: in directions in which the loops hardly
// say anything, each step goes a part of the way, and as many steps go the same part.
constexpr int kSmoothSteps = 6;
// Slopes are kept for so many steps more after one that began with all as near as this, or after one before
// which this was open. The number is the same for all: a step with slopes of elsewhere goes elsewhere, by
// what is open times how far away they are from.
constexpr int kKeptSteps = 3;
constexpr double kNearlyOpen = 0.1;
// Solutions for a step with slopes that are kept, or before such: what the next one corrects, because it
// begins with all that is open, needs no correction of its own.
constexpr int kOnce = 1;
constexpr double kRounded = 1e-10;  // of a residual, after which one step more is the last
constexpr double kNotNearer = 0.5;  // of a residual
constexpr double kSettled = 1e-11;  // below it steps need not get nearer
constexpr int kMostHalvings = 6;
// Of drawing near: steps, the least share of one, and what one must gain.
constexpr int kMostNearer = 40;
constexpr double kLeastNearer = 1.0 / 256.0;
constexpr double kGain = 0.01;
constexpr double kNearlyClosed = 5e-11;
// No fold is turned by more in one step, radians.
constexpr double kLongestStep = 0.5;
// After a step that leaves so little of a residual the slopes do for one more.
constexpr double kKeepsSlopes = 0.1;

// Steps of work of a loop's crossing of a fold, in its residual.
constexpr double kTermSteps = 60.0;
// Of one, in what a solution leaves of the change.
constexpr double kSlopeSteps = 24.0;

}  // namespace

Closure::Closure(const Sheet& sheet, const std::vector<int>& folds, const std::vector<int>& loops, Work& work)
    : Closure(sheet, folds, plan_steps(sheet, folds, loops, work), work) {}

Closure::Closure(const Sheet& sheet, const std::vector<int>& folds, StepPlan plan, Work& work)
    : work_(&work),
      affordable_(plan.affordable),
      factor_work_(plan.factors()),
      solution_work_(plan.solution),
      closing_(equations(sheet, folds, std::move(plan))) {}

ClosingStep Closure::equations(const Sheet& sheet, const std::vector<int>& folds, StepPlan plan) {
    Eigen::VectorXd ease = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(folds.size()));
    std::unordered_map<int, int> column;
    for (std::size_t i = 0; i < folds.size(); ++i) {
        column[folds[i]] = static_cast<int>(i);
        if (!nth(sheet.folds, folds[i]).is_bend()) continue;
        ease[static_cast<Eigen::Index>(i)] = 1.0 / (kBendCost * kBendCost);
        bends_ = true;
    }
    std::vector<LoopRow> rows;
    std::vector<int> columns;
    int count = 0;
    rows.reserve(plan.loops.size());
    for (const int number : plan.loops) {
        const Loop& loop = nth(sheet.loops, number);
        LoopRow row;
        row.loop = number;
        row.first = count;
        row.count = loop.corner ? 3 : 6;
        row.begin = terms_.size();
        count += row.count;
        for (const Step& one : loop.steps) {
            const Segment line = sheet.line_of(nth(sheet.folds, one.fold));
            const Vec2 dir = unit(line.b - line.a);
            Vec2 at = line.a - loop.at;
            at = at - dot(at, dir) * dir;
            if (loop.corner) at = {};
            columns.push_back(column.at(one.fold));
            terms_.push_back({one.sign, {at.x / loop.size, at.y / loop.size, 0.0}, {dir.x, dir.y, 0.0}});
        }
        row.end = terms_.size();
        rows.push_back(row);
    }
    residual_.resize(count);
    slopes_.resize(terms_.size());
    turns_.resize(folds.size());
    return {std::move(rows), std::move(columns), std::move(ease), std::move(plan.angle_order)};
}

void Closure::evaluate(const Eigen::VectorXd& angles, bool slopes) {
    work_->spend(kTermSteps * static_cast<double>(terms_.size()));
    sines_cosines({angles.data(), static_cast<std::size_t>(angles.size())}, turns_);
    for (const LoopRow& row : closing_.rows()) {
        const Rigid3 motion = row.count == 3 ? around_corner(row, slopes) : around(row, slopes);
        const Vec3 turn = turn_of(motion);
        residual_.segment<3>(row.first) << turn.x, turn.y, turn.z;
        if (row.count == 6)
            residual_.segment<3>(row.first + 3) << motion.shift.x, motion.shift.y, motion.shift.z;
    }
}

SineCosine Closure::turn_in(std::size_t term) const {
    SineCosine by = nth(turns_, closing_.angle_of(term));
    by.sine *= terms_[term].sign;
    return by;
}

Rigid3 Closure::around_corner(const LoopRow& row, bool slopes) {
    Rigid3 motion;
    for (std::size_t i = row.begin; i < row.end; ++i) {
        const Term& term = terms_[i];
        const Vec3 along = motion.direction_in_sheet(term.dir);
        if (slopes) slopes_[i] = {term.sign * along.x, term.sign * along.y, term.sign * along.z};
        motion = motion.after_turn_at_origin(term.dir, along, turn_in(i));
    }
    return motion;
}

Rigid3 Closure::around(const LoopRow& row, bool slopes) {
    Rigid3 motion;
    for (std::size_t i = row.begin; i < row.end; ++i) {
        const Term& term = terms_[i];
        if (slopes) {
            const Vec3 dir = term.sign * motion.direction(term.dir);
            const Vec3 moment = cross(motion.point(term.at), dir);
            slopes_[i] = {dir.x, dir.y, dir.z, moment.x, moment.y, moment.z};
        }
        motion = motion.after_turn(term.at, term.dir, turn_in(i));
    }
    return motion;
}

double Closure::residual(const Eigen::VectorXd& angles, int* worst) {
    evaluate(angles, false);
    double largest = -1.0;
    for (const LoopRow& row : closing_.rows()) {
        const double own = residual_.segment(row.first, row.count).lpNorm<Eigen::Infinity>();
        if (!(own > largest)) continue;
        largest = own;
        if (worst != nullptr) *worst = row.loop;
    }
    return largest;
}

// False if the work that is left does not do for it.
bool Closure::factorise() {
    if (!work_->spend(factor_work_)) return false;
    const double mean_square = residual_.squaredNorm() / static_cast<double>(residual_.size());
    return closing_.factorise(slopes_, kRegular + kDamped * mean_square);
}

bool Closure::step(const Eigen::VectorXd& change, Eigen::VectorXd& by, int most) {
    const int solutions = closing_.find(slopes_, change, by, most);
    const double terms = static_cast<double>(terms_.size());
    work_->spend(solutions * (solution_work_ + kSlopeSteps * terms));
    return solutions > 0;
}

int Closure::approach_smoothly(std::span<Eigen::VectorXd> all, double enough, bool near) {
    Eigen::VectorXd by;
    std::vector<double> open(all.size(), HUGE_VAL);
    bool keeps = near;  // slopes
    for (int round = 0;; ++round) {
        const bool last = round == kSmoothSteps;
        double worst = 0.0;
        bool all_there = true;
        for (std::size_t i = 0; i < all.size(); ++i) {
            evaluate(all[i], !last);
            const double before = residual_.lpNorm<Eigen::Infinity>();
            if (last ? !(before <= enough) : !(before <= kNotNearer * open[i])) return static_cast<int>(i);
            worst = std::max(worst, before);
            open[i] = std::max(before, kSettled);
            if (last) continue;
            const int most = keeps ? kOnce : kUntilRounding;
            if (!factorise() || !step(-residual_, by, most) || by.lpNorm<Eigen::Infinity>() > kLongestStep)
                return static_cast<int>(i);
            all[i] += by;
            if (keeps ? !keep_slopes(all[i]) : before > kRounded) all_there = false;
        }
        if (last || all_there) return -1;
        keeps = worst <= kNearlyOpen;
    }
}

// A few steps more with the slopes of the last one. Returns whether only rounding is left.
bool Closure::keep_slopes(Eigen::VectorXd& angles) {
    Eigen::VectorXd by;
    for (int i = 0; i < kKeptSteps; ++i) {
        evaluate(angles, false);
        const double left = residual_.lpNorm<Eigen::Infinity>();
        if (!step(-residual_, by, kOnce)) return false;
        angles += by;
        if (left <= kRounded) return true;
    }
    return false;
}

Eigen::VectorXd Closure::along_loops(const Eigen::VectorXd& angles, const Eigen::VectorXd& direction) {
    evaluate(angles, true);
    if (!factorise()) return Eigen::VectorXd::Zero(direction.size());
    Eigen::VectorXd left = direction;
    Eigen::VectorXd by;
    // Once more, for what the regularisation leaves.
    for (int i = 0; i < 2 && step(closing_.change_by(slopes_, left), by); ++i) left -= by;
    return left;
}

void Closure::draw_near(Eigen::VectorXd& angles, const Eigen::VectorXd& to) {
    const auto away = [&](const Eigen::VectorXd& at) {
        const Eigen::VectorXd by = to - at;
        return by.cwiseAbs2().cwiseQuotient(closing_.ease()).sum();
    };
    double here = away(angles);
    double share = 1.0;
    for (int i = 0; i < kMostNearer && share > kLeastNearer; ++i) {
        const Eigen::VectorXd way = along_loops(angles, to - angles);
        bool nearer = false;
        for (; !nearer && share > kLeastNearer; share *= 0.5) {
            Eigen::VectorXd next = angles + share * way;
            if (!(approach(next) <= kNearlyClosed)) continue;
            const double there = away(next);
            if (!(there < (1.0 - kGain * share) * here)) continue;
            angles = std::move(next);
            here = there;
            nearer = true;
            share *= 2.0;
        }
        if (!nearer) break;
        share = std::min(1.0, 2.0 * share);
    }
}

double Closure::approach(Eigen::VectorXd& angles, double enough, const GivesUp& gives_up) {
    double here = residual(angles);
    Eigen::VectorXd by;
    bool keep = false;  // the slopes of the step before
    for (int i = 0; i < kMostSteps && here > enough; ++i) {
        if (gives_up && gives_up(angles, here)) break;
        if (!keep) {
            evaluate(angles, true);
            if (!factorise()) break;
        }
        if (!step(-residual_, by)) break;
        const double longest = by.lpNorm<Eigen::Infinity>();
        double share = longest > kLongestStep ? kLongestStep / longest : 1.0;
        const double before = here;
        for (int k = 0; k <= kMostHalvings && here == before; ++k, share *= 0.5) {
            const Eigen::VectorXd next = angles + share * by;
            const double there = residual(next);
            if (!(there < here)) continue;
            angles = next;
            here = there;
        }
        if (here == before && !keep) break;
        keep = here <= kKeepsSlopes * before;
    }
    return here;
}

}  // namespace popup::folded
