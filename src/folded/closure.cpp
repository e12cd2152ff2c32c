#include "folded/closure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "base/nth.h"
#include "folded/rigid.h"

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

}  // namespace

Closure::Closure(const Sheet& sheet, const std::vector<int>& folds, const std::vector<int>& loops) {
    std::map<int, int> column;
    for (std::size_t i = 0; i < folds.size(); ++i) {
        column[folds[i]] = static_cast<int>(i);
        if (!nth(sheet.folds, folds[i]).is_bend()) continue;
        if (ease_.size() == 0) ease_.setOnes(static_cast<Eigen::Index>(folds.size()));
        ease_[static_cast<Eigen::Index>(i)] = 1.0 / (kBendCost * kBendCost);
    }
    int count = 0;
    rows_.reserve(loops.size());
    for (const int number : loops) {
        const Loop& loop = nth(sheet.loops, number);
        Row row;
        row.loop = number;
        row.first = count;
        row.corner = loop.corner;
        row.size = loop.size;
        count += loop.corner ? 3 : 6;
        row.terms.reserve(loop.steps.size());
        for (const Step& one : loop.steps) {
            const Fold& fold = nth(sheet.folds, one.fold);
            const Segment line = sheet.line_of(fold);
            const Vec2 dir = unit(line.b - line.a);
            Vec2 at = line.a - loop.at;
            at = at - dot(at, dir) * dir;
            if (loop.corner) at = {};
            row.terms.push_back({column.at(one.fold),
                                 one.sign,
                                 {at.x / loop.size, at.y / loop.size, 0.0},
                                 {dir.x, dir.y, 0.0}});
        }
        rows_.push_back(std::move(row));
    }
    residual_.resize(count);
    slopes_.resize(count, static_cast<Eigen::Index>(folds.size()));
}

void Closure::evaluate(const Eigen::VectorXd& angles, bool slopes) {
    if (slopes) entries_.clear();
    for (const Row& row : rows_) {
        Rigid3 motion;
        for (const Term& term : row.terms) {
            if (slopes) {
                const Vec3 dir = term.sign * motion.direction(term.dir);
                const Vec3 moment = cross(motion.point(term.at), dir);
                const std::array<double, 6> screw{dir.x, dir.y, dir.z, moment.x, moment.y, moment.z};
                for (int i = 0; i < (row.corner ? 3 : 6); ++i)
                    entries_.emplace_back(row.first + i, term.column, screw.at(static_cast<std::size_t>(i)));
            }
            motion = motion.after_turn(term.at, term.dir, term.sign * angles[term.column]);
        }
        const Vec3 turn = turn_of(motion);
        residual_.segment<3>(row.first) << turn.x, turn.y, turn.z;
        if (!row.corner) {
            residual_.segment<3>(row.first + 3) << motion.shift.x, motion.shift.y, motion.shift.z;
        }
    }
    if (slopes) slopes_.setFromTriplets(entries_.begin(), entries_.end());
}

double Closure::residual(const Eigen::VectorXd& angles, int* worst) {
    evaluate(angles, false);
    double largest = -1.0;
    for (const Row& row : rows_) {
        const double own = residual_.segment(row.first, row.corner ? 3 : 6).lpNorm<Eigen::Infinity>();
        if (!(own > largest)) continue;
        largest = own;
        if (worst != nullptr) *worst = row.loop;
    }
    return largest;
}

double Closure::gap_mm(const Eigen::VectorXd& angles) {
    evaluate(angles, false);
    double largest = 0.0;
    for (const Row& row : rows_) {
        const double own = residual_.segment(row.first, row.corner ? 3 : 6).lpNorm<Eigen::Infinity>();
        largest = std::max(largest, own * row.size);
    }
    return largest;
}

void Closure::factorise() {
    transposed_ = slopes_.transpose();
    if (ease_.size() > 0) transposed_ = ease_.asDiagonal() * transposed_;
    Matrix normal = slopes_ * transposed_;
    const double mean_square = residual_.squaredNorm() / static_cast<double>(residual_.size());
    const double damping = kRegular + kDamped * mean_square;
    for (Eigen::Index i = 0; i < normal.rows(); ++i) normal.coeffRef(i, i) += damping;
    if (!analysed_) {
        solver_.analyzePattern(normal);
        analysed_ = true;
    }
    solver_.factorize(normal);
}

bool Closure::step(const Eigen::VectorXd& residuals, Eigen::VectorXd& by) {
    if (solver_.info() != Eigen::Success) return false;
    by = transposed_ * solver_.solve(residuals);
    return by.allFinite();
}

int Closure::approach_smoothly(std::span<Eigen::VectorXd> all, double enough) {
    Eigen::VectorXd by;
    std::vector<double> open(all.size(), HUGE_VAL);
    for (int round = 0;; ++round) {
        double worst = 0.0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const bool last = round == kSmoothSteps;
            evaluate(all[i], !last);
            const double before = residual_.lpNorm<Eigen::Infinity>();
            if (last ? !(before <= enough) : !(before <= kNotNearer * open[i])) return static_cast<int>(i);
            worst = std::max(worst, before);
            open[i] = std::max(before, kSettled);
            if (last) continue;
            factorise();
            if (!step(-residual_, by) || by.lpNorm<Eigen::Infinity>() > kLongestStep)
                return static_cast<int>(i);
            all[i] += by;
        }
        // What was this near before the step is at rounding after it.
        if (round == kSmoothSteps || worst <= kRounded) return -1;
    }
}

Eigen::VectorXd Closure::along_loops(const Eigen::VectorXd& angles, const Eigen::VectorXd& direction) {
    evaluate(angles, true);
    factorise();
    Eigen::VectorXd left = direction;
    Eigen::VectorXd by;
    // Once more, for what the regularisation leaves.
    for (int i = 0; i < 2 && step(slopes_ * left, by); ++i) left -= by;
    return left;
}

void Closure::draw_near(Eigen::VectorXd& angles, const Eigen::VectorXd& to) {
    const auto away = [&](const Eigen::VectorXd& at) {
        const Eigen::VectorXd by = to - at;
        return ease_.size() > 0 ? by.cwiseAbs2().cwiseQuotient(ease_).sum() : by.squaredNorm();
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

double Closure::approach(Eigen::VectorXd& angles, double enough) {
    double here = residual(angles);
    Eigen::VectorXd by;
    for (int i = 0; i < kMostSteps && here > enough; ++i) {
        evaluate(angles, true);
        factorise();
        if (!step(-residual_, by)) break;
        const double longest = by.lpNorm<Eigen::Infinity>();
        double share = longest > kLongestStep ? kLongestStep / longest : 1.0;
        bool nearer = false;
        for (int k = 0; k <= kMostHalvings && !nearer; ++k, share *= 0.5) {
            const Eigen::VectorXd next = angles + share * by;
            const double there = residual(next);
            if (!(there < here)) continue;
            angles = next;
            here = there;
            nearer = true;
        }
        if (!nearer) break;
    }
    return here;
}

}  // namespace popup::folded
