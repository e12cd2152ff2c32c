#include "folded/carton/point_system.h"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

#include "base/nth.h"

namespace popup::folded {
namespace {

// The points in an order in which few blocks fill up.
std::vector<int> order_of(int points, const std::vector<std::pair<int, int>>& pairs) {
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto& [a, b] : pairs) {
        entries.emplace_back(a, b, 1.0);
        entries.emplace_back(b, a, 1.0);
    }
    for (int i = 0; i < points; ++i) entries.emplace_back(i, i, 1.0);
    Eigen::SparseMatrix<double> pattern(points, points);
    pattern.setFromTriplets(entries.begin(), entries.end());
    Eigen::AMDOrdering<int>::PermutationType order;
    Eigen::AMDOrdering<int>()(pattern, order);
    return {order.indices().begin(), order.indices().end()};
}

// By column the rows below the diagonal that have a block in the factors, given those in the matrix.
void fill_up(std::vector<std::vector<int>>& below) {
    std::vector<std::vector<std::size_t>> from(below.size());  // columns that leave theirs to this one
    std::vector<std::size_t> seen(below.size(), below.size());
    for (std::size_t column = 0; column < below.size(); ++column) {
        std::vector<int> rows;
        const auto take = [&](const std::vector<int>& some) {
            for (const int row : some) {
                if (static_cast<std::size_t>(row) == column || nth(seen, row) == column) continue;
                nth(seen, row) = column;
                rows.push_back(row);
            }
        };
        take(below[column]);
        for (const std::size_t other : from[column]) take(below[other]);
        std::sort(rows.begin(), rows.end());
        if (!rows.empty()) nth(from, rows.front()).push_back(column);
        below[column] = std::move(rows);
    }
}

// Turns a diagonal block into its L and, upside down, D; false: there are none.
bool split(double* block) {
    const double first = block[0];
    const double a = block[3];
    const double b = block[6];
    block[3] = a / first;
    block[6] = b / first;
    const double second = block[4] - block[3] * a;
    const double c = block[7] - block[6] * a;
    block[7] = c / second;
    const double third = block[8] - block[6] * b - block[7] * c;
    block[0] = 1.0 / first;
    block[4] = 1.0 / second;
    block[8] = 1.0 / third;
    return std::isfinite(block[0]) && std::isfinite(block[4]) && std::isfinite(block[8]);
}

// target -= one times other'
void take_away(double* target, const double* one, const double* other) {
    for (int row = 0; row < 3; ++row) {
        const double x = one[3 * row];
        const double y = one[3 * row + 1];
        const double z = one[3 * row + 2];
        target[3 * row] -= x * other[0] + y * other[1] + z * other[2];
        target[3 * row + 1] -= x * other[3] + y * other[4] + z * other[5];
        target[3 * row + 2] -= x * other[6] + y * other[7] + z * other[8];
    }
}

}  // namespace

PointSystem::PointSystem(int points, const std::vector<std::pair<int, int>>& pairs)
    : place_(static_cast<std::size_t>(points)), point_(order_of(points, pairs)) {
    for (std::size_t i = 0; i < point_.size(); ++i) nth(place_, point_[i]) = static_cast<int>(i);
    std::vector<std::vector<int>> below(place_.size());
    for (const auto& [a, b] : pairs) {
        const auto [low, high] = std::minmax(nth(place_, a), nth(place_, b));
        nth(below, low).push_back(high);
    }
    fill_up(below);
    std::size_t longest = 0;
    for (std::size_t column = 0; column < below.size(); ++column) {
        begin_.push_back(rows_.size());
        rows_.push_back(static_cast<int>(column));
        rows_.insert(rows_.end(), below[column].begin(), below[column].end());
        longest = std::max(longest, below[column].size());
    }
    begin_.push_back(rows_.size());
    column_.resize(9 * longest);
}

PointSystem::Block PointSystem::block(int a, int b) const {
    const int row = nth(place_, a);
    const int column = nth(place_, b);
    const auto first = rows_.begin() + static_cast<std::ptrdiff_t>(nth(begin_, std::min(row, column)));
    const auto last = rows_.begin() + static_cast<std::ptrdiff_t>(nth(begin_, std::min(row, column) + 1));
    const auto found = std::lower_bound(first, last, std::max(row, column));
    return {9 * static_cast<std::size_t>(found - rows_.begin()), row < column};
}

void PointSystem::eliminate(std::size_t column) {
    const double* const diagonal = factors_.data() + 9 * begin_[column];
    const std::size_t first = begin_[column] + 1;
    const std::size_t last = begin_[column + 1];
    for (std::size_t i = first; i < last; ++i) {
        double* const block = factors_.data() + 9 * i;
        double* const scaled = column_.data() + 9 * (i - first);
        for (int row = 0; row < 9; row += 3) {
            const double x = block[row];
            const double y = block[row + 1] - diagonal[3] * x;
            const double z = block[row + 2] - diagonal[6] * x - diagonal[7] * y;
            scaled[row] = x;
            scaled[row + 1] = y;
            scaled[row + 2] = z;
            block[row] = x * diagonal[0];
            block[row + 1] = y * diagonal[4];
            block[row + 2] = z * diagonal[8];
        }
    }
    for (std::size_t i = first; i < last; ++i) {
        std::size_t target = nth(begin_, rows_[i]);
        for (std::size_t j = i; j < last; ++j) {
            while (rows_[target] != rows_[j]) ++target;  // what is left of a column is a part of the next one
            take_away(factors_.data() + 9 * target, factors_.data() + 9 * j,
                      column_.data() + 9 * (i - first));
        }
    }
}

bool PointSystem::factorize(const std::vector<double>& matrix, double more) {
    factors_ = matrix;
    for (std::size_t column = 0; column + 1 < begin_.size(); ++column) {
        double* const diagonal = factors_.data() + 9 * begin_[column];
        for (const int i : {0, 4, 8}) diagonal[i] += more;
    }
    for (std::size_t column = 0; column + 1 < begin_.size(); ++column) {
        if (!split(factors_.data() + 9 * begin_[column])) return false;
        eliminate(column);
    }
    return true;
}

void PointSystem::solve(Eigen::VectorXd& right) const {
    Eigen::VectorXd own(right.size());
    for (std::size_t i = 0; i < point_.size(); ++i)
        own.segment<3>(3 * static_cast<Eigen::Index>(i)) = right.segment<3>(3 * Eigen::Index{point_[i]});
    for (std::size_t column = 0; column < point_.size(); ++column) {
        const double* block = factors_.data() + 9 * begin_[column];
        double* const at = own.data() + 3 * column;
        at[1] -= block[3] * at[0];
        at[2] -= block[6] * at[0] + block[7] * at[1];
        for (std::size_t i = begin_[column] + 1; i < begin_[column + 1]; ++i) {
            block += 9;
            double* const to = own.data() + 3 * static_cast<std::size_t>(rows_[i]);
            for (int row = 0; row < 3; ++row) {
                to[row] -= block[3 * row] * at[0] + block[3 * row + 1] * at[1] + block[3 * row + 2] * at[2];
            }
        }
        block = factors_.data() + 9 * begin_[column];
        for (const int i : {0, 1, 2}) at[i] *= block[4 * i];
    }
    for (std::size_t column = point_.size(); column-- > 0;) {
        double* const at = own.data() + 3 * column;
        for (std::size_t i = begin_[column] + 1; i < begin_[column + 1]; ++i) {
            const double* const block = factors_.data() + 9 * i;
            const double* const from = own.data() + 3 * static_cast<std::size_t>(rows_[i]);
            for (int to = 0; to < 3; ++to)
                at[to] -= block[to] * from[0] + block[to + 3] * from[1] + block[to + 6] * from[2];
        }
        const double* const diagonal = factors_.data() + 9 * begin_[column];
        at[1] -= diagonal[7] * at[2];
        at[0] -= diagonal[3] * at[1] + diagonal[6] * at[2];
    }
    for (std::size_t i = 0; i < point_.size(); ++i)
        right.segment<3>(3 * Eigen::Index{point_[i]}) = own.segment<3>(3 * static_cast<Eigen::Index>(i));
}

}  // namespace popup::folded
