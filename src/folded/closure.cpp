#include "folded/closure.h"

#include <Eigen/OrderingMethods>
#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <vector>

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
// After a step that leaves so little of a residual the slopes do for one more.
constexpr double kKeepsSlopes = 0.1;

// No motion is found in fewer factorisations.
constexpr double kLeastFactorisations = 60.0;
// Steps of work: of a loop's crossing of a fold, in its residual; of an entry of the normal equations.
constexpr double kTermSteps = 60.0;
constexpr double kEntrySteps = 4.0;

// By fold: the loops that cross it, in their order.
std::vector<std::vector<int>> loops_across(const Sheet& sheet, const std::vector<int>& loops) {
    std::vector<std::vector<int>> across(sheet.folds.size());
    for (std::size_t i = 0; i < loops.size(); ++i) {
        for (const Step& step : nth(sheet.loops, loops[i]).steps)
            nth(across, step.fold).push_back(static_cast<int>(i));
    }
    return across;
}

// Loops in the order of least degree (Amestoy, Davis and Duff, An approximate minimum degree ordering
// algorithm, 1996), so that the factors of their normal equations stay sparse: for loops as a whole, which
// takes a ninth of what it takes for conditions.
std::vector<int> ordered(const Sheet& sheet, const std::vector<int>& loops) {
    std::vector<Eigen::Triplet<double>> entries;
    for (const std::vector<int>& beside : loops_across(sheet, loops)) {
        for (const int a : beside) {
            for (const int b : beside) entries.emplace_back(a, b, 1.0);
        }
    }
    const auto count = static_cast<Eigen::Index>(loops.size());
    Eigen::SparseMatrix<double> joined(count, count);
    joined.setFromTriplets(entries.begin(), entries.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
    Eigen::AMDOrdering<int>()(joined, order);
    std::vector<int> result;
    result.reserve(loops.size());
    for (Eigen::Index i = 0; i < count; ++i)
        result.push_back(loops[static_cast<std::size_t>(order.indices()[i])]);
    return result;
}

}  // namespace

Closure::Closure(const Sheet& sheet, const std::vector<int>& folds, const std::vector<int>& loops, Work& work)
    : work_(&work) {
    // A fold that many loops cross joins each of them to each other.
    double entries = 0.0;
    for (const std::vector<int>& beside : loops_across(sheet, loops))
        entries += 36.0 * static_cast<double>(beside.size() * beside.size());
    if (!work.has(kLeastFactorisations * kEntrySteps * entries)) return;
    const std::vector<int> order = ordered(sheet, loops);
    factor_steps_ = kEntrySteps * entries;
    affordable_ = can_afford(sheet, order);
    if (!affordable_) return;
    ease_.setOnes(static_cast<Eigen::Index>(folds.size()));
    for (std::size_t i = 0; i < folds.size(); ++i) {
        if (!nth(sheet.folds, folds[i]).is_bend()) continue;
        ease_[static_cast<Eigen::Index>(i)] = 1.0 / (kBendCost * kBendCost);
        bends_ = true;
    }
    add_rows(sheet, folds, order);
    add_products(folds.size());
}

// Whether the factors of the normal equations, in that order of the loops, are so sparse that enough of them
// can be made. Loops as a whole are eliminated one after the other: each joins those after it that it hangs
// together with, and all that is told of it goes to the first of these (its parent in the elimination tree;
// Liu, The role of elimination trees in sparse factorization, 1990).
bool Closure::can_afford(const Sheet& sheet, const std::vector<int>& loops) {
    const std::size_t count = loops.size();
    std::vector<std::vector<int>> before(count);  // by loop: those earlier in the order that share a fold
    for (const std::vector<int>& beside : loops_across(sheet, loops)) {
        for (std::size_t i = 1; i < beside.size(); ++i) {
            for (std::size_t k = 0; k < i; ++k) {
                if (beside[k] != beside[i]) nth(before, beside[i]).push_back(beside[k]);
            }
        }
    }
    const auto conditions = [&](std::size_t i) { return nth(sheet.loops, loops[i]).corner ? 3.0 : 6.0; };
    std::vector<int> parent(count, -1);
    std::vector<int> seen(count, -1);       // the last loop whose row has an entry in this column
    std::vector<double> below(count, 0.0);  // conditions below the diagonal, by column
    double entries = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        seen[i] = static_cast<int>(i);
        for (int at : before[i]) {
            for (; nth(seen, at) != static_cast<int>(i); at = nth(parent, at)) {
                if (nth(parent, at) < 0) nth(parent, at) = static_cast<int>(i);
                nth(seen, at) = static_cast<int>(i);
                nth(below, at) += conditions(i);
                entries += 1.0;
            }
        }
        if (!work_->has(kLeastFactorisations * entries)) return false;
    }
    for (std::size_t i = 0; i < count; ++i) {
        const double own = conditions(i);
        factor_steps_ += own * (own + below[i]) * (own + below[i]);
    }
    return work_->has(kLeastFactorisations * factor_steps_);
}

void Closure::add_rows(const Sheet& sheet, const std::vector<int>& folds, const std::vector<int>& loops) {
    std::unordered_map<int, int> column;
    for (std::size_t i = 0; i < folds.size(); ++i) column[folds[i]] = static_cast<int>(i);
    int count = 0;
    rows_.reserve(loops.size());
    for (const int number : loops) {
        const Loop& loop = nth(sheet.loops, number);
        Row row;
        row.loop = number;
        row.first = count;
        row.count = loop.corner ? 3 : 6;
        row.size = loop.size;
        row.begin = terms_.size();
        count += row.count;
        for (const Step& one : loop.steps) {
            const Fold& fold = nth(sheet.folds, one.fold);
            const Segment line = sheet.line_of(fold);
            const Vec2 dir = unit(line.b - line.a);
            Vec2 at = line.a - loop.at;
            at = at - dot(at, dir) * dir;
            if (loop.corner) at = {};
            terms_.push_back({column.at(one.fold),
                              one.sign,
                              {at.x / loop.size, at.y / loop.size, 0.0},
                              {dir.x, dir.y, 0.0}});
        }
        row.end = terms_.size();
        rows_.push_back(row);
    }
    residual_.resize(count);
    slopes_.resize(terms_.size());
}

void Closure::add_products(std::size_t folds) {
    struct Place {
        std::size_t row = 0, term = 0;
    };
    std::vector<std::vector<Place>> of(folds);  // by fold: where it is crossed, in the order of the rows
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        for (std::size_t k = rows_[i].begin; k < rows_[i].end; ++k)
            nth(of, terms_[k].column).push_back({i, k});
    }
    // All entries of a block, so that those of a column of it lie side by side.
    std::vector<Eigen::Triplet<double>> entries;
    const auto each_pair = [&](const auto& visit) {
        for (const std::vector<Place>& places : of) {
            for (std::size_t i = 0; i < places.size(); ++i) {
                for (std::size_t k = i; k < places.size(); ++k) visit(places[i], places[k]);
            }
        }
    };
    const auto block = [&](const Row& upper, const Row& left) {
        for (int column = 0; column < left.count; ++column) {
            const int rows = &upper == &left ? column + 1 : upper.count;
            for (int row = 0; row < rows; ++row)
                entries.emplace_back(upper.first + row, left.first + column, 0.0);
        }
    };
    for (const Row& row : rows_) block(row, row);
    each_pair([&](const Place& upper, const Place& left) {
        if (upper.row != left.row) block(rows_[upper.row], rows_[left.row]);
    });
    normal_.resize(residual_.size(), residual_.size());
    normal_.setFromTriplets(entries.begin(), entries.end());
    normal_.makeCompressed();
    const auto place_of = [this](int row, int column) {
        const int* const begin = normal_.innerIndexPtr() + normal_.outerIndexPtr()[column];
        const int* const end = normal_.innerIndexPtr() + normal_.outerIndexPtr()[column + 1];
        return static_cast<int>(std::lower_bound(begin, end, row) - normal_.innerIndexPtr());
    };
    each_pair([&](const Place& upper, const Place& left) {
        const Row& above = rows_[upper.row];
        const Row& beside = rows_[left.row];
        Product product{upper.term, left.term, above.count, beside.count, upper.row == left.row};
        for (int i = 0; i < beside.count; ++i) nth(product.at, i) = place_of(above.first, beside.first + i);
        products_.push_back(product);
    });
    diagonal_.reserve(static_cast<std::size_t>(residual_.size()));
    for (int i = 0; i < residual_.size(); ++i) diagonal_.push_back(place_of(i, i));
}

void Closure::evaluate(const Eigen::VectorXd& angles, bool slopes) {
    work_->spend(kTermSteps * static_cast<double>(terms_.size()));
    for (const Row& row : rows_) {
        Rigid3 motion;
        for (std::size_t i = row.begin; i < row.end; ++i) {
            const Term& term = terms_[i];
            if (slopes) {
                const Vec3 dir = term.sign * motion.direction(term.dir);
                const Vec3 moment = cross(motion.point(term.at), dir);
                slopes_[i] = {dir.x, dir.y, dir.z, moment.x, moment.y, moment.z};
            }
            motion = motion.after_turn(term.at, term.dir, term.sign * angles[term.column]);
        }
        const Vec3 turn = turn_of(motion);
        residual_.segment<3>(row.first) << turn.x, turn.y, turn.z;
        if (row.count == 6)
            residual_.segment<3>(row.first + 3) << motion.shift.x, motion.shift.y, motion.shift.z;
    }
}

double Closure::residual(const Eigen::VectorXd& angles, int* worst) {
    evaluate(angles, false);
    double largest = -1.0;
    for (const Row& row : rows_) {
        const double own = residual_.segment(row.first, row.count).lpNorm<Eigen::Infinity>();
        if (!(own > largest)) continue;
        largest = own;
        if (worst != nullptr) *worst = row.loop;
    }
    return largest;
}

// False if the work that is left does not do for it.
bool Closure::factorise() {
    if (!work_->spend(factor_steps_)) return false;
    double* const values = normal_.valuePtr();
    std::fill(values, values + normal_.nonZeros(), 0.0);
    for (const Product& product : products_) {
        const std::array<double, 6>& rows = slopes_[product.upper];
        const std::array<double, 6>& columns = slopes_[product.left];
        const double ease = ease_[terms_[product.upper].column];
        // A loop that crosses a fold twice has its products with itself both ways.
        const bool twice = product.diagonal && product.upper != product.left;
        for (int column = 0; column < product.columns; ++column) {
            double* const at = values + nth(product.at, column);
            const int count = product.diagonal ? column + 1 : product.rows;
            for (int row = 0; row < count; ++row) {
                double value = nth(rows, row) * nth(columns, column);
                if (twice) value += nth(columns, row) * nth(rows, column);
                at[row] += ease * value;
            }
        }
    }
    const double mean_square = residual_.squaredNorm() / static_cast<double>(residual_.size());
    const double damping = kRegular + kDamped * mean_square;
    for (const int at : diagonal_) values[at] += damping;
    if (!analysed_) {
        solver_.analyzePattern(normal_);
        analysed_ = true;
    }
    solver_.factorize(normal_);
    return solver_.info() == Eigen::Success;
}

bool Closure::step(const Eigen::VectorXd& residuals, Eigen::VectorXd& by) {
    const Eigen::VectorXd loads = solver_.solve(residuals);
    by.setZero(ease_.size());
    for (const Row& row : rows_) {
        for (std::size_t i = row.begin; i < row.end; ++i) {
            double sum = 0.0;
            for (int k = 0; k < row.count; ++k) sum += nth(slopes_[i], k) * loads[row.first + k];
            by[terms_[i].column] += sum;
        }
    }
    by.array() *= ease_.array();
    return by.allFinite();
}

Eigen::VectorXd Closure::change_by(const Eigen::VectorXd& by) const {
    Eigen::VectorXd change = Eigen::VectorXd::Zero(residual_.size());
    for (const Row& row : rows_) {
        for (std::size_t i = row.begin; i < row.end; ++i) {
            for (int k = 0; k < row.count; ++k)
                change[row.first + k] += nth(slopes_[i], k) * by[terms_[i].column];
        }
    }
    return change;
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
            if (!factorise() || !step(-residual_, by) || by.lpNorm<Eigen::Infinity>() > kLongestStep)
                return static_cast<int>(i);
            all[i] += by;
        }
        // What was this near before the step is at rounding after it.
        if (round == kSmoothSteps || worst <= kRounded) return -1;
    }
}

Eigen::VectorXd Closure::along_loops(const Eigen::VectorXd& angles, const Eigen::VectorXd& direction) {
    evaluate(angles, true);
    if (!factorise()) return Eigen::VectorXd::Zero(direction.size());
    Eigen::VectorXd left = direction;
    Eigen::VectorXd by;
    // Once more, for what the regularisation leaves.
    for (int i = 0; i < 2 && step(change_by(left), by); ++i) left -= by;
    return left;
}

void Closure::draw_near(Eigen::VectorXd& angles, const Eigen::VectorXd& to) {
    const auto away = [&](const Eigen::VectorXd& at) {
        const Eigen::VectorXd by = to - at;
        return by.cwiseAbs2().cwiseQuotient(ease_).sum();
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
    bool keep = false;  // the slopes of the step before
    for (int i = 0; i < kMostSteps && here > enough; ++i) {
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
