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

// Loops in the order of least degree (Amestoy, Davis and Duff, An approximate minimum degree ordering
// algorithm, 1996), so that the factors of their normal equations stay sparse: for loops as a whole, which
// takes a ninth of what it takes for conditions.
std::vector<int> ordered(const Sheet& sheet, const std::vector<int>& loops) {
    std::vector<std::vector<int>> across(sheet.folds.size());  // by fold: the loops that cross it
    for (std::size_t i = 0; i < loops.size(); ++i) {
        for (const Step& step : nth(sheet.loops, loops[i]).steps)
            nth(across, step.fold).push_back(static_cast<int>(i));
    }
    std::vector<Eigen::Triplet<double>> entries;
    for (const std::vector<int>& beside : across) {
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

Closure::Closure(const Sheet& sheet, const std::vector<int>& folds, const std::vector<int>& loops) {
    ease_.setOnes(static_cast<Eigen::Index>(folds.size()));
    for (std::size_t i = 0; i < folds.size(); ++i) {
        if (!nth(sheet.folds, folds[i]).is_bend()) continue;
        ease_[static_cast<Eigen::Index>(i)] = 1.0 / (kBendCost * kBendCost);
        bends_ = true;
    }
    add_rows(sheet, folds, ordered(sheet, loops));
    add_products(folds.size());
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

void Closure::factorise() {
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
}

bool Closure::step(const Eigen::VectorXd& residuals, Eigen::VectorXd& by) {
    if (solver_.info() != Eigen::Success) return false;
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
            factorise();
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
