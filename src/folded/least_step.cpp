#include "folded/least_step.h"

#include <algorithm>
#include <utility>

#include "base/nth.h"
#include "folded/plane_order.h"

namespace popup::folded {
namespace {

// Below this damping the equations of angles hardly say anything of directions in which no loop opens, and
// what rounding leaves there is taken out.
constexpr double kSaysLittle = 1e-9;

// Pairs of `count`, each with itself included.
std::size_t pairs_of(std::size_t count) { return count * (count + 1) / 2; }

}  // namespace

LeastStep::LeastStep(std::vector<LoopRow> rows, std::vector<int> columns, Eigen::VectorXd ease,
                     const std::vector<Vec2>& places)
    : rows_(std::move(rows)), columns_(std::move(columns)), ease_(std::move(ease)), root_(ease_.cwiseSqrt()) {
    std::vector<std::vector<Place>> of(static_cast<std::size_t>(ease_.size()));
    std::size_t by_angles = 0;
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        const LoopRow& row = rows_[i];
        for (std::size_t k = row.begin; k < row.end; ++k) nth(of, columns_[k]).push_back({i, k});
        by_angles += pairs_of(row.end - row.begin);
    }
    std::size_t by_conditions = 0;
    for (const std::vector<Place>& around : of) {
        std::size_t conditions = 0;
        for (const Place& place : around) conditions += static_cast<std::size_t>(rows_[place.row].count);
        by_conditions += pairs_of(conditions);
    }
    of_angles_ = by_angles <= by_conditions;
    if (of_angles_) {
        arrange_angles(places);
    } else {
        arrange_conditions(of);
    }
}

void LeastStep::make_matrix(int size, const std::vector<Eigen::Triplet<double>>& entries) {
    normal_.resize(size, size);
    normal_.setFromTriplets(entries.begin(), entries.end());
    normal_.makeCompressed();
    diagonal_.reserve(static_cast<std::size_t>(size));
    for (int i = 0; i < size; ++i) diagonal_.push_back(place_of(i, i));
}

int LeastStep::place_of(int row, int column) const {
    const int* const begin = normal_.innerIndexPtr() + normal_.outerIndexPtr()[column];
    const int* const end = normal_.innerIndexPtr() + normal_.outerIndexPtr()[column + 1];
    return static_cast<int>(std::lower_bound(begin, end, row) - normal_.innerIndexPtr());
}

void LeastStep::arrange_angles(const std::vector<Vec2>& places) {
    std::vector<std::vector<int>> joined;
    joined.reserve(rows_.size());
    for (const LoopRow& row : rows_) {
        const auto begin = columns_.begin();
        joined.emplace_back(begin + static_cast<std::ptrdiff_t>(row.begin),
                            begin + static_cast<std::ptrdiff_t>(row.end));
    }
    order_ = plane_order(joined, places);
    std::vector<Eigen::Triplet<double>> entries;
    const auto each_pair = [&](const auto& visit) {
        for (const LoopRow& row : rows_) {
            for (std::size_t i = row.begin; i < row.end; ++i) {
                for (std::size_t k = i; k < row.end; ++k) {
                    const int a = nth(order_, columns_[i]);
                    const int b = nth(order_, columns_[k]);
                    visit(std::min(a, b), std::max(a, b));
                }
            }
        }
    };
    for (int i = 0; i < static_cast<int>(order_.size()); ++i) entries.emplace_back(i, i, 0.0);
    each_pair([&](int upper, int left) { entries.emplace_back(upper, left, 0.0); });
    make_matrix(static_cast<int>(order_.size()), entries);
    each_pair([&](int upper, int left) { pairs_.push_back(place_of(upper, left)); });
}

void LeastStep::arrange_conditions(const std::vector<std::vector<Place>>& of) {
    std::vector<std::vector<int>> joined;
    joined.reserve(of.size());
    for (const std::vector<Place>& around : of) {
        joined.emplace_back();
        for (const Place& place : around) joined.back().push_back(static_cast<int>(place.row));
    }
    const std::vector<int> places = least_degree_order(joined, static_cast<int>(rows_.size()));
    std::vector<std::size_t> by_place(rows_.size());
    for (std::size_t i = 0; i < rows_.size(); ++i) nth(by_place, places[i]) = i;
    std::vector<int> first(rows_.size());  // equation, by row
    int conditions = 0;
    for (const std::size_t row : by_place) {
        first[row] = conditions;
        conditions += rows_[row].count;
    }
    order_.resize(static_cast<std::size_t>(conditions));
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        for (int k = 0; k < rows_[i].count; ++k) nth(order_, rows_[i].first + k) = first[i] + k;
    }
    // All entries of a block, so that those of a column of it lie side by side.
    std::vector<Eigen::Triplet<double>> entries;
    const auto block = [&](std::size_t upper, std::size_t left) {
        for (int column = 0; column < rows_[left].count; ++column) {
            const int rows = upper == left ? column + 1 : rows_[upper].count;
            for (int row = 0; row < rows; ++row)
                entries.emplace_back(first[upper] + row, first[left] + column, 0.0);
        }
    };
    const auto each_pair = [&](const auto& visit) {
        for (const std::vector<Place>& around : of) {
            for (std::size_t i = 0; i < around.size(); ++i) {
                for (std::size_t k = i; k < around.size(); ++k) {
                    const bool in_order = first[around[i].row] <= first[around[k].row];
                    visit(around[in_order ? i : k], around[in_order ? k : i]);
                }
            }
        }
    };
    for (std::size_t i = 0; i < rows_.size(); ++i) block(i, i);
    each_pair([&](const Place& upper, const Place& left) {
        if (upper.row != left.row) block(upper.row, left.row);
    });
    make_matrix(conditions, entries);
    each_pair([&](const Place& upper, const Place& left) {
        const int columns = rows_[left.row].count;
        Product product{upper.term, left.term, rows_[upper.row].count, columns, upper.row == left.row};
        for (int i = 0; i < columns; ++i)
            nth(product.at, i) = place_of(first[upper.row], first[left.row] + i);
        products_.push_back(product);
    });
}

void LeastStep::add_angles(const std::vector<Slope>& slopes) {
    double* const values = normal_.valuePtr();
    const int* at = pairs_.data();
    for (const LoopRow& row : rows_) {
        for (std::size_t i = row.begin; i < row.end; ++i) {
            const Slope& one = slopes[i];
            for (std::size_t k = i; k < row.end; ++k) {
                const Slope& other = slopes[k];
                double sum = 0.0;
                for (int j = 0; j < row.count; ++j) sum += nth(one, j) * nth(other, j);
                // A loop that crosses a fold twice has its product with itself both ways.
                if (i != k && columns_[i] == columns_[k]) sum *= 2.0;
                values[*at++] += root_[columns_[i]] * root_[columns_[k]] * sum;
            }
        }
    }
}

void LeastStep::add_conditions(const std::vector<Slope>& slopes) {
    double* const values = normal_.valuePtr();
    for (const Product& product : products_) {
        const Slope& rows = slopes[product.upper];
        const Slope& columns = slopes[product.left];
        const double ease = ease_[columns_[product.upper]];
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
}

void LeastStep::factorise(const std::vector<Slope>& slopes, double damping) {
    double* const values = normal_.valuePtr();
    std::fill(values, values + normal_.nonZeros(), 0.0);
    if (of_angles_) {
        add_angles(slopes);
    } else {
        add_conditions(slopes);
    }
    damping_ = damping;
    for (const int at : diagonal_) values[at] += damping;
    if (!analysed_) {
        solver_.analyzePattern(normal_);
        analysed_ = true;
    }
    solver_.factorize(normal_);
}

void LeastStep::slope_back(const std::vector<Slope>& slopes, const Eigen::VectorXd& conditions,
                           Eigen::VectorXd& by) const {
    by.setZero(ease_.size());
    for (const LoopRow& row : rows_) {
        for (std::size_t i = row.begin; i < row.end; ++i) {
            double sum = 0.0;
            for (int k = 0; k < row.count; ++k) sum += nth(slopes[i], k) * conditions[row.first + k];
            by[columns_[i]] += sum;
        }
    }
}

bool LeastStep::find(const std::vector<Slope>& slopes, const Eigen::VectorXd& change,
                     Eigen::VectorXd& by) const {
    if (solver_.info() != Eigen::Success) return false;
    const auto count = static_cast<Eigen::Index>(order_.size());
    Eigen::VectorXd ordered(count);
    if (!of_angles_) {
        for (Eigen::Index i = 0; i < count; ++i) ordered[nth(order_, i)] = change[i];
        const Eigen::VectorXd found = solver_.solve(ordered);
        for (Eigen::Index i = 0; i < count; ++i) ordered[i] = found[nth(order_, i)];
        slope_back(slopes, ordered, by);
        by.array() *= ease_.array();
        return by.allFinite();
    }
    slope_back(slopes, change, by);
    for (Eigen::Index i = 0; i < count; ++i) ordered[nth(order_, i)] = root_[i] * by[i];
    Eigen::VectorXd found = solver_.solve(ordered);
    if (damping_ < kSaysLittle) found -= damping_ * Eigen::VectorXd(solver_.solve(found));
    for (Eigen::Index i = 0; i < count; ++i) by[i] = root_[i] * found[nth(order_, i)];
    return by.allFinite();
}

}  // namespace popup::folded
