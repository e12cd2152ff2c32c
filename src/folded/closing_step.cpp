#include "folded/closing_step.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/nth.h"
#include "folded/corrections.h"

namespace popup::folded {

ClosingStep::ClosingStep(std::vector<LoopRow> rows, std::vector<int> columns, Eigen::VectorXd ease,
                         std::vector<int> angle_order)
    : rows_(std::move(rows)),
      columns_(std::move(columns)),
      ease_(std::move(ease)),
      root_(ease_.cwiseSqrt()),
      order_(std::move(angle_order)) {
    if (of_angles()) {
        arrange_angles();
    } else {
        arrange_conditions();
    }
}

void ClosingStep::make_matrix(int size, const std::vector<Eigen::Triplet<double>>& entries) {
    normal_.resize(size, size);
    normal_.setFromTriplets(entries.begin(), entries.end());
    normal_.makeCompressed();
    diagonal_.reserve(static_cast<std::size_t>(size));
    for (int i = 0; i < size; ++i) diagonal_.push_back(place_of(i, i));
}

int ClosingStep::place_of(int row, int column) const {
    const int* const begin = normal_.innerIndexPtr() + normal_.outerIndexPtr()[column];
    const int* const end = normal_.innerIndexPtr() + normal_.outerIndexPtr()[column + 1];
    return static_cast<int>(std::lower_bound(begin, end, row) - normal_.innerIndexPtr());
}

void ClosingStep::arrange_angles() {
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
    entries.reserve(order_.size());
    for (int i = 0; i < static_cast<int>(order_.size()); ++i) entries.emplace_back(i, i, 0.0);
    each_pair([&](int upper, int left) { entries.emplace_back(upper, left, 0.0); });
    make_matrix(static_cast<int>(order_.size()), entries);
    each_pair([&](int upper, int left) { pairs_.push_back(place_of(upper, left)); });
}

void ClosingStep::arrange_conditions() {
    struct Crossing {
        std::size_t row = 0, term = 0;
    };
    std::vector<std::vector<Crossing>> of(static_cast<std::size_t>(ease_.size()));  // by angle, as the rows
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        for (std::size_t k = rows_[i].begin; k < rows_[i].end; ++k) nth(of, columns_[k]).push_back({i, k});
    }
    // All entries of a block, so that those of a column of it lie side by side.
    std::vector<Eigen::Triplet<double>> entries;
    const auto each_pair = [&](const auto& visit) {
        for (const std::vector<Crossing>& around : of) {
            for (std::size_t i = 0; i < around.size(); ++i) {
                for (std::size_t k = i; k < around.size(); ++k) visit(around[i], around[k]);
            }
        }
    };
    const auto block = [&](const LoopRow& upper, const LoopRow& left) {
        for (int column = 0; column < left.count; ++column) {
            const int rows = &upper == &left ? column + 1 : upper.count;
            for (int row = 0; row < rows; ++row)
                entries.emplace_back(upper.first + row, left.first + column, 0.0);
        }
    };
    for (const LoopRow& row : rows_) block(row, row);
    each_pair([&](const Crossing& upper, const Crossing& left) {
        if (upper.row != left.row) block(rows_[upper.row], rows_[left.row]);
    });
    make_matrix(rows_.empty() ? 0 : rows_.back().first + rows_.back().count, entries);
    each_pair([&](const Crossing& upper, const Crossing& left) {
        const LoopRow& above = rows_[upper.row];
        const LoopRow& beside = rows_[left.row];
        Product product{upper.term, left.term, above.count, beside.count, upper.row == left.row};
        for (int i = 0; i < beside.count; ++i) nth(product.at, i) = place_of(above.first, beside.first + i);
        products_.push_back(product);
    });
}

// Loops around corners have three conditions, and are nearly all there are: what is summed over as many as
// are known when this is compiled takes a third.
template <typename Visit>
void ClosingStep::each_row(const Visit& visit) const {
    for (const LoopRow& row : rows_) {
        if (row.count == 3) {
            visit.template operator()<3>(row);
        } else {
            visit.template operator()<6>(row);
        }
    }
}

void ClosingStep::add_angles(const std::vector<Slope>& slopes) {
    double* const values = normal_.valuePtr();
    const int* at = pairs_.data();
    each_row([&]<std::size_t Count>(const LoopRow& row) {
        for (std::size_t i = row.begin; i < row.end; ++i) {
            const Slope& one = slopes[i];
            for (std::size_t k = i; k < row.end; ++k) {
                const Slope& other = slopes[k];
                double sum = 0.0;
                for (std::size_t j = 0; j < Count; ++j) sum += one[j] * other[j];
                // A loop that crosses a fold twice has its product with itself both ways.
                if (i != k && columns_[i] == columns_[k]) sum *= 2.0;
                values[*at++] += root_[columns_[i]] * root_[columns_[k]] * sum;
            }
        }
    });
}

void ClosingStep::add_conditions(const std::vector<Slope>& slopes) {
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

bool ClosingStep::factorise(const std::vector<Slope>& slopes, double damping) {
    double* const values = normal_.valuePtr();
    std::fill(values, values + normal_.nonZeros(), 0.0);
    if (of_angles()) {
        add_angles(slopes);
    } else {
        add_conditions(slopes);
    }
    damping_ = damping;
    for (const int at : diagonal_) values[at] += damping;
    if (!factors_.is_analysed()) factors_.analyse(normal_, {});
    rate_ = {};
    return factors_.factorise(normal_);
}

void ClosingStep::slope_back(const std::vector<Slope>& slopes, const Eigen::VectorXd& conditions,
                             Eigen::VectorXd& by) const {
    by.setZero(ease_.size());
    each_row([&]<std::size_t Count>(const LoopRow& row) {
        const double* const own = conditions.data() + row.first;
        for (std::size_t i = row.begin; i < row.end; ++i) {
            double sum = 0.0;
            for (std::size_t k = 0; k < Count; ++k) sum += slopes[i][k] * own[k];
            by[columns_[i]] += sum;
        }
    });
}

Eigen::VectorXd ClosingStep::change_by(const std::vector<Slope>& slopes, const Eigen::VectorXd& by) const {
    Eigen::VectorXd change(rows_.empty() ? 0 : rows_.back().first + rows_.back().count);
    each_row([&]<std::size_t Count>(const LoopRow& row) {
        std::array<double, Count> sums{};
        for (std::size_t i = row.begin; i < row.end; ++i) {
            const double own = by[columns_[i]];
            for (std::size_t k = 0; k < Count; ++k) sums[k] += slopes[i][k] * own;
        }
        std::copy(sums.begin(), sums.end(), change.data() + row.first);
    });
    return change;
}

// All that the factors know of the slopes is their squares, to 1e-16 of the largest, and a step depends on
// slopes of the size of the root of the damping, 3e-7. So steps are corrected by what the slopes themselves
// leave of the change (Björck, Numerical Methods for Least Squares Problems, 1996, 2.9), until a correction
// is no smaller than rounding makes it.
int ClosingStep::find(const std::vector<Slope>& slopes, const Eigen::VectorXd& change, Eigen::VectorXd& by,
                      int most) {
    by.setZero(ease_.size());
    const int solutions =
        of_angles() ? find_by_angles(slopes, change, by, most) : find_by_conditions(slopes, change, by, most);
    return by.allFinite() ? solutions : 0;
}

int ClosingStep::find_by_conditions(const std::vector<Slope>& slopes, const Eigen::VectorXd& change,
                                    Eigen::VectorXd& by, int most) {
    Eigen::VectorXd loads = Eigen::VectorXd::Zero(change.size());
    return add_corrections(by, rate_, most, [&](Eigen::VectorXd& correction) {
        Eigen::VectorXd more = change - change_by(slopes, by) - damping_ * loads;
        factors_.solve(more);
        loads += more;
        slope_back(slopes, more, correction);
        correction.array() *= ease_.array();
    });
}

// A direction in which no loop opens has nothing but the damping in the equations, and of their rounding a
// thousandth of the step stands there in the solution. The slopes give nothing back of it, so each correction
// takes it out, but for a thousandth.
int ClosingStep::find_by_angles(const std::vector<Slope>& slopes, const Eigen::VectorXd& change,
                                Eigen::VectorXd& by, int most) {
    const auto count = static_cast<Eigen::Index>(order_.size());
    Eigen::VectorXd ordered(count);
    Eigen::VectorXd back;
    return add_corrections(by, rate_, most, [&](Eigen::VectorXd& correction) {
        slope_back(slopes, change - change_by(slopes, by), back);
        for (Eigen::Index i = 0; i < count; ++i)
            ordered[nth(order_, i)] = root_[i] * back[i] - damping_ * (by[i] / root_[i]);
        factors_.solve(ordered);
        for (Eigen::Index i = 0; i < count; ++i) correction[i] = root_[i] * ordered[nth(order_, i)];
    });
}

}  // namespace popup::folded
