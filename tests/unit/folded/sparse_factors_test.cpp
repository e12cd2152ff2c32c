// Factors by blocks against dense ones with more digits.
#include "folded/sparse_factors.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include "base/nth.h"
#include "support/random.h"

namespace popup::folded {
namespace {

using test::Random;
using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
using Entries = std::vector<Eigen::Triplet<double>>;

SparseFactors::Matrix matrix_of(int size, const Entries& entries) {
    SparseFactors::Matrix matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    matrix.makeCompressed();
    return matrix;
}

double value(Random& random) { return 2.0 * random.unit() - 1.0; }

// The diagonal is larger than all beside it, and negative in places: these are factors L D Lᵀ.
Entries with_diagonal(int size, Entries entries, Random& random) {
    std::vector<double> beside(static_cast<std::size_t>(size), 1.0);
    for (const Eigen::Triplet<double>& entry : entries) {
        nth(beside, entry.row()) += std::abs(entry.value());
        nth(beside, entry.col()) += std::abs(entry.value());
    }
    for (int i = 0; i < size; ++i)
        entries.emplace_back(i, i, (random.unit() < 0.2 ? -1.0 : 1.0) * nth(beside, i));
    return entries;
}

// Pairs of equations that hang together anyhow.
Entries scattered(int size, int pairs, Random& random) {
    Entries entries;
    for (int i = 0; i < pairs; ++i) {
        const int a = static_cast<int>(random.unit() * size);
        const int b = static_cast<int>(random.unit() * size);
        if (a != b) entries.emplace_back(std::min(a, b), std::max(a, b), value(random));
    }
    return with_diagonal(size, std::move(entries), random);
}

Entries grid(int side, Random& random) {
    Entries entries;
    for (int i = 0; i < side * side; ++i) {
        if (i % side + 1 < side) entries.emplace_back(i, i + 1, value(random));
        if (i + side < side * side) entries.emplace_back(i, i + side, value(random));
    }
    return with_diagonal(side * side, std::move(entries), random);
}

// All hang together with the last, or with the first.
Entries star(int size, bool at_first, Random& random) {
    Entries entries;
    for (int i = 1; i < size; ++i) {
        if (at_first) entries.emplace_back(0, i, value(random));
        if (!at_first) entries.emplace_back(i - 1, size - 1, value(random));
    }
    return with_diagonal(size, std::move(entries), random);
}

std::vector<int> shuffled(int size, Random& random) {
    std::vector<int> order(static_cast<std::size_t>(size));
    std::iota(order.begin(), order.end(), 0);
    for (std::size_t i = order.size(); i > 1; --i)
        std::swap(order[i - 1], order[static_cast<std::size_t>(random.unit() * static_cast<double>(i))]);
    return order;
}

void expect_solution(int size, const Entries& entries, const std::vector<int>& order, Random& random) {
    SparseFactors::Matrix matrix = matrix_of(size, entries);
    SparseFactors factors;
    factors.analyse(matrix, order);
    // Twice, with other values at the same places.
    for (const double times : {1.0, -3.0}) {
        matrix *= times;
        LongMatrix dense = LongMatrix(Eigen::MatrixXd(matrix).cast<long double>());
        dense.triangularView<Eigen::StrictlyLower>() = dense.transpose();
        Eigen::VectorXd right(size);
        for (double& one : right) one = value(random);
        const LongVector expected = dense.partialPivLu().solve(LongVector(right.cast<long double>()));
        ASSERT_TRUE(factors.factorise(matrix));
        factors.solve(right);
        EXPECT_LT((right.cast<long double>() - expected).lpNorm<Eigen::Infinity>(),
                  1e-13L * expected.lpNorm<Eigen::Infinity>())
            << size << " equations";
    }
}

TEST(SparseFactors, SolveWhateverHangsTogether) {
    Random random(11);
    for (int i = 0; i < 40; ++i) {
        const int size = 1 + 3 * i;
        expect_solution(size, scattered(size, 2 * size, random), {}, random);
        expect_solution(size, scattered(size, size / 2, random), shuffled(size, random), random);
        expect_solution(size, star(size, i % 2 == 0, random), {}, random);
        expect_solution(size, scattered(size, size * size, random), shuffled(size, random), random);
    }
    for (const int side : {5, 12, 17}) {
        expect_solution(side * side, grid(side, random), {}, random);
        expect_solution(side * side, grid(side, random), shuffled(side * side, random), random);
    }
}

TEST(SparseFactors, LookAtNothingBelowTheDiagonal) {
    Random random(12);
    const Entries above = grid(6, random);
    Entries both = above;
    for (const Eigen::Triplet<double>& entry : above) {
        if (entry.row() != entry.col()) both.emplace_back(entry.col(), entry.row(), 1000.0);
    }
    Eigen::VectorXd one = Eigen::VectorXd::Ones(36);
    Eigen::VectorXd other = one;
    const auto solve = [](const Entries& entries, Eigen::VectorXd& x) {
        const SparseFactors::Matrix matrix = matrix_of(36, entries);
        SparseFactors factors;
        factors.analyse(matrix, {});
        ASSERT_TRUE(factors.factorise(matrix));
        factors.solve(x);
    };
    solve(above, one);
    solve(both, other);
    EXPECT_EQ(one, other);
}

// Of a chain each column has one entry beside its diagonal, of a star whose middle comes first all have all.
TEST(SparseFactors, SayWhatTheyTake) {
    Random random(13);
    Entries chain;
    for (int i = 0; i + 1 < 10; ++i) chain.emplace_back(i, i + 1, value(random));
    SparseFactors factors;
    factors.analyse(matrix_of(10, with_diagonal(10, chain, random)), {});
    EXPECT_EQ(factors.entries(), 19.0);
    EXPECT_EQ(factors.steps(), 9.0 * 4.0 + 1.0);
    SparseFactors of_star;
    of_star.analyse(matrix_of(10, star(10, true, random)), {});
    EXPECT_EQ(of_star.entries(), 55.0);
    EXPECT_EQ(of_star.steps(), 385.0);
}

TEST(SparseFactors, AreNoneWhereAPivotIsNought) {
    SparseFactors factors;
    const SparseFactors::Matrix matrix =
        matrix_of(3, {{0, 0, 1.0}, {0, 1, 1.0}, {1, 1, 1.0}, {1, 2, 1.0}, {2, 2, 1.0}});
    factors.analyse(matrix, {});
    EXPECT_FALSE(factors.factorise(matrix));
}

}  // namespace
}  // namespace popup::folded
