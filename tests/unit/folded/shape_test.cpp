// How shapes of cartons are solved: normal equations in blocks, their factors, and projections. What is
// expected is computed here with dense matrices.
#include "folded/carton/shape.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <utility>
#include <vector>

#include "folded/carton/point_system.h"
#include "folded/carton/project_shape.h"
#include "folded/carton/shape_conditions.h"

namespace popup::folded {
namespace {

using Vector = Eigen::VectorXd;

// Two panels on a fold, (0, 1), one of them with four corners, and a third that is to meet the second at a
// corner and to lie in its plane. All are a little bent, so that nothing is nought.
Shape bent_shape() {
    Shape shape;
    shape.at = {{0, 0, 0.3},    {40, 1, 0},    {41, 30, 0.5}, {0, 31, -0.4}, {39, -8.2, 19}, {1, -9, 20},
                {38, -7.5, 21}, {60, -12, 20}, {55, -3, 35},  {-3, 2, 8},    {-4, 30, 9.5}};
    shape.panels = {{{0, 1, 2, 3}, {{0, 0}, {40, 0}, {40, 30}, {0, 30}}},
                    {{1, 0, 5, 4}, {{40, 0}, {0, 0}, {0, -20}, {40, -20}}},
                    {{6, 7, 8}, {{100, 0}, {122, 3}, {118, 19}}},
                    // It has a corner of the first panel among its own.
                    {{0, 9, 10, 3}, {{0, 0}, {-9, 0}, {-9, 30}, {0, 30}}}};
    return shape;
}
ShapeJoins bent_joins() { return {{{4, 6}, {5, 9, 10}}, {{1, 2}, {0, 3}}}; }

Vector places(const Shape& shape) {
    Vector x(3 * static_cast<Eigen::Index>(shape.at.size()));
    for (std::size_t i = 0; i < shape.at.size(); ++i)
        x.segment<3>(3 * static_cast<Eigen::Index>(i)) << shape.at[i].x, shape.at[i].y, shape.at[i].z;
    return x;
}

Eigen::MatrixXd dense(const PointSystem& system, const std::vector<double>& matrix, int points,
                      const std::vector<std::pair<int, int>>& pairs) {
    Eigen::MatrixXd all = Eigen::MatrixXd::Zero(3 * points, 3 * points);
    const auto put = [&](int a, int b) {
        const PointSystem::Block block = system.block(a, b);
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column) {
                const double value = matrix[block.at + static_cast<std::size_t>(3 * row + column)];
                const int at_a = 3 * a + (block.turned ? column : row);
                const int at_b = 3 * b + (block.turned ? row : column);
                all(at_a, at_b) = value;
                all(at_b, at_a) = value;
            }
        }
    };
    for (int i = 0; i < points; ++i) put(i, i);
    for (const auto& [a, b] : pairs) put(a, b);
    return all;
}

TEST(PointSystem, SolvesWhatADenseMatrixSolves) {
    constexpr int kPoints = 9;
    // A wheel with a tail: eliminating anything but the tail fills up blocks.
    std::vector<std::pair<int, int>> pairs{{7, 6}, {8, 7}, {2, 1}};
    for (int i = 1; i <= 6; ++i) {
        pairs.emplace_back(0, i);
        pairs.emplace_back(i, i % 6 + 1);
    }
    PointSystem system(kPoints, pairs);
    std::vector<double> matrix = system.nought();
    for (int i = 0; i < kPoints; ++i) {
        PointSystem::add_units(matrix, system.block(i, i), 30.0 + i);
        PointSystem::add(matrix, system.block(i, i), {1.0, 0.5 * i, -1.0}, {1.0, 0.5 * i, -1.0});
    }
    for (const auto& [a, b] : pairs)
        PointSystem::add(matrix, system.block(a, b), {1.0 * a, 2.0, -0.3 * b}, {0.2 * b, -1.0, 0.7 * a});
    const Eigen::MatrixXd whole = dense(system, matrix, kPoints, pairs);
    // The block of a pair has its rows by the first point, whichever comes first in the factors.
    EXPECT_DOUBLE_EQ(whole(3 * 8, 3 * 7 + 1), -8.0);
    EXPECT_DOUBLE_EQ(whole(3 * 7 + 1, 3 * 8), -8.0);
    for (const double more : {0.0, 2.5}) {
        ASSERT_TRUE(system.factorize(matrix, more));
        Vector right = Vector::LinSpaced(3 * kPoints, -4.0, 9.0);
        const Vector expected =
            (whole + more * Eigen::MatrixXd::Identity(3 * kPoints, 3 * kPoints)).fullPivLu().solve(right);
        system.solve(right);
        EXPECT_LT((right - expected).lpNorm<Eigen::Infinity>(), 1e-12);
    }
}

TEST(PointSystem, SaysThatNoughtHasNoFactors) {
    PointSystem system(2, {{0, 1}});
    EXPECT_FALSE(system.factorize(system.nought(), 0.0));
    EXPECT_TRUE(system.factorize(system.nought(), 1.0));
}

TEST(ShapeConditions, HaveTheSlopesOfTheirValues) {
    const Shape shape = bent_shape();
    ShapeConditions conditions(shape, bent_joins());
    const Vector x = places(shape);
    Vector left;
    conditions.evaluate(x, left);
    ASSERT_EQ(left.size(), 4 * 3 + 3 * 3 + 3 * 3 + 2 * 3);
    EXPECT_EQ(conditions.owner(6), std::pair(Solved::Worst::panel, 1));
    EXPECT_EQ(conditions.owner(21), std::pair(Solved::Worst::merge, 0));
    EXPECT_EQ(conditions.owner(left.size() - 1), std::pair(Solved::Worst::plane, 1));
    EXPECT_EQ((left.array() == 0.0).count(), 1);  // the corner that a panel and its plane share
    Eigen::MatrixXd slopes(left.size(), x.size());
    constexpr double kStep = 1e-5;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        Vector more = x;
        Vector less = x;
        more[i] += kStep;
        less[i] -= kStep;
        Vector above;
        Vector below;
        conditions.evaluate(more, above);
        conditions.evaluate(less, below);
        slopes.col(i) = (above - below) / (2.0 * kStep);
    }
    std::vector<double> normal;
    Vector slope;
    conditions.linearise(x, left, normal, slope);
    EXPECT_LT((slope - slopes.transpose() * left).lpNorm<Eigen::Infinity>(), 1e-6);
    std::vector<std::pair<int, int>> pairs;  // all that a condition has in common
    const Eigen::MatrixXd expected = slopes.transpose() * slopes;
    for (int a = 0; a < static_cast<int>(shape.at.size()); ++a) {
        for (int b = 0; b < a; ++b) {
            if (!expected.block<3, 3>(Eigen::Index{3} * a, Eigen::Index{3} * b).isZero(1e-7))
                pairs.emplace_back(a, b);
        }
    }
    const Eigen::MatrixXd found =
        dense(conditions.system(), normal, static_cast<int>(shape.at.size()), pairs);
    EXPECT_LT((found - expected).lpNorm<Eigen::Infinity>(), 1e-6);
}

// The middle of the folded panels stays, and each has its shape again after many rounds.
TEST(ProjectShape, BringsBentPanelsToTheirShape) {
    Shape shape = bent_shape();
    shape.panels.pop_back();
    const ShapeJoins joins{{{4, 6}}, {}};
    const Vector near = project_shape(shape, joins, places(shape), 1e-6);
    ShapeConditions conditions(shape, joins);
    Vector before;
    Vector after;
    conditions.evaluate(places(shape), before);
    conditions.evaluate(near, after);
    EXPECT_GT(before.lpNorm<Eigen::Infinity>(), 1.0);
    EXPECT_LT(after.lpNorm<Eigen::Infinity>(), 1e-3);
}

// A panel whose corners have come to lie in a line, or in one place, goes somewhere all the same.
TEST(ProjectShape, BearsPanelsThatHaveCollapsed) {
    Shape shape;
    shape.panels = {{{0, 1, 2}, {{0, 0}, {30, 0}, {0, 20}}}};
    for (const double size : {0.0, 10.0}) {
        shape.at = {{0, 0, 0}, {size, 0, 0}, {2 * size, 0, 0}};
        const Vector near = project_shape(shape, {}, places(shape), 1e-6);
        ASSERT_TRUE(near.allFinite());
        EXPECT_NEAR((near.head<3>() - near.segment<3>(3)).norm(), 30.0, 1e-3);
        EXPECT_NEAR((near.head<3>() - near.segment<3>(6)).norm(), 20.0, 1e-3);
    }
}

TEST(SolveShape, ClosesWhatCanBeClosedAndNamesTheWorstElse) {
    Shape shape = bent_shape();
    shape.panels.pop_back();
    const Solved closed = solve_shape(shape, {{{4, 6}}, {{1, 2}}}, {.size_mm = 100.0});
    EXPECT_TRUE(closed.closes);
    EXPECT_LT(closed.residual_mm, 1e-7);
    const Vec3 apart = closed.at[4] - closed.at[6];
    EXPECT_LT(length(apart), 1e-7);
    // Corners of one panel cannot meet.
    const Solved open = solve_shape(shape, {{{2, 3}}, {}}, {.size_mm = 100.0});
    EXPECT_FALSE(open.closes);
    EXPECT_GT(open.residual_mm, 5.0);
    EXPECT_NE(open.worst, Solved::Worst::nothing);
}

}  // namespace
}  // namespace popup::folded
