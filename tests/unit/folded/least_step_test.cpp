// The smallest step against the formula with full matrices, whichever equations it is found from.
#include "folded/least_step.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "base/nth.h"
#include "folded/plane_order.h"
#include "support/random.h"

namespace popup::folded {
namespace {

using test::Random;

// Loops over angles, their slopes at random, and what they have to become.
struct StepQuestion {
    std::vector<LoopRow> rows;
    std::vector<int> columns;
    std::vector<LeastStep::Slope> slopes;
    Eigen::VectorXd ease, change;
    std::vector<Vec2> places;
};

void add_loop(StepQuestion& question, const std::vector<int>& angles, int conditions, Random& random) {
    LoopRow row;
    row.loop = static_cast<int>(question.rows.size());
    row.first = question.rows.empty() ? 0 : question.rows.back().first + question.rows.back().count;
    row.count = conditions;
    row.begin = question.columns.size();
    for (const int angle : angles) {
        question.columns.push_back(angle);
        question.slopes.emplace_back();
        for (double& value : question.slopes.back()) value = 2.0 * random.unit() - 1.0;
    }
    row.end = question.columns.size();
    question.rows.push_back(row);
}

void finish(StepQuestion& question, int angles, Random& random) {
    question.ease.resize(angles);
    for (double& value : question.ease) value = 0.1 + 0.9 * random.unit();
    question.change.resize(question.rows.back().first + question.rows.back().count);
    for (double& value : question.change) value = 2.0 * random.unit() - 1.0;
    for (int i = 0; i < angles; ++i) question.places.push_back({100.0 * random.unit(), 60.0 * random.unit()});
}

// A grid of corners with four folds each: folds across, then folds up.
StepQuestion grid(int columns, int rows, Random& random) {
    StepQuestion question;
    const int across = (columns + 1) * rows;
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const int left = j * (columns + 1) + i;
            const int below = across + j * columns + i;
            add_loop(question, {left, left + 1, below, below + columns}, 3, random);
        }
    }
    finish(question, across + columns * (rows + 1), random);
    return question;
}

// Rings of many folds around a hole each, and one that crosses two folds twice.
StepQuestion rings(int count, int folds, Random& random) {
    StepQuestion question;
    std::vector<int> angles(static_cast<std::size_t>(folds));
    for (int i = 0; i < count; ++i) {
        std::iota(angles.begin(), angles.end(), i * (folds - 1));
        if (i == 0) angles.insert(angles.end(), {0, 1});
        add_loop(question, angles, 6, random);
        if (i == 0) angles.resize(static_cast<std::size_t>(folds));
    }
    finish(question, count * (folds - 1) + 1, random);
    return question;
}

// D Jᵀ (J D Jᵀ + d)⁻¹ r.
Eigen::VectorXd by_formula(const StepQuestion& question, double damping) {
    Eigen::MatrixXd slopes = Eigen::MatrixXd::Zero(question.change.size(), question.ease.size());
    for (const LoopRow& row : question.rows) {
        for (std::size_t i = row.begin; i < row.end; ++i) {
            for (int k = 0; k < row.count; ++k)
                slopes(row.first + k, question.columns[i]) += nth(question.slopes[i], k);
        }
    }
    const Eigen::MatrixXd eased = slopes * question.ease.asDiagonal();
    Eigen::MatrixXd normal = eased * slopes.transpose();
    normal.diagonal().array() += damping;
    return eased.transpose() * normal.ldlt().solve(question.change);
}

void expect_step(const StepQuestion& question, bool of_angles) {
    LeastStep least(question.rows, question.columns, question.ease, question.places);
    EXPECT_EQ(least.of_angles(), of_angles);
    for (const double damping : {1.0, 1e-3}) {
        least.factorise(question.slopes, damping);
        Eigen::VectorXd by;
        ASSERT_TRUE(least.find(question.slopes, question.change, by));
        const Eigen::VectorXd expected = by_formula(question, damping);
        EXPECT_LT((by - expected).lpNorm<Eigen::Infinity>(), 1e-10 * expected.lpNorm<Eigen::Infinity>())
            << damping;
    }
}

TEST(LeastStep, OfATessellationIsFoundFromItsAngles) {
    Random random(3);
    expect_step(grid(1, 1, random), true);
    for (int i = 0; i < 20; ++i) expect_step(grid(2 + i % 7, 1 + i % 5, random), true);
}

TEST(LeastStep, OfLoopsOfManyFoldsIsFoundFromItsConditions) {
    Random random(4);
    for (int i = 0; i < 10; ++i) expect_step(rings(1 + i, 120 - i, random), false);
}

// With hardly any damping, a step asks for nothing in directions in which no loop opens.
TEST(LeastStep, KeepsOutWhatOpensNoLoop) {
    Random random(5);
    StepQuestion question = grid(6, 5, random);
    // Of each corner's slopes only one direction is left: 30 conditions on 71 angles.
    for (LeastStep::Slope& slope : question.slopes) slope = {slope[0], 0.0, 0.0, 0.0, 0.0, 0.0};
    for (Eigen::Index i = 0; i < question.change.size(); ++i) {
        if (i % 3 != 0) question.change[i] = 0.0;
    }
    LeastStep least(question.rows, question.columns, question.ease, question.places);
    least.factorise(question.slopes, 1e-13);
    Eigen::VectorXd by;
    ASSERT_TRUE(least.find(question.slopes, question.change, by));
    const Eigen::VectorXd expected = by_formula(question, 1e-13);
    EXPECT_LT((by - expected).lpNorm<Eigen::Infinity>(), 1e-5 * expected.lpNorm<Eigen::Infinity>());
}

// Corners of a grid, joined along its lines: an order leaves as much as elimination fills in.
TEST(PlaneOrder, IsAnOrderThatFillsLittle) {
    constexpr int side = 24;
    std::vector<std::vector<int>> joined;
    std::vector<Vec2> places;
    for (int i = 0; i < side * side; ++i) {
        places.push_back({static_cast<double>(i % side), static_cast<double>(i / side)});
        if (i % side + 1 < side) joined.push_back({i, i + 1});
        if (i + side < side * side) joined.push_back({i, i + side});
    }
    const auto fill = [&](const std::vector<int>& order) {
        std::vector<std::vector<char>> full(places.size(), std::vector<char>(places.size(), 0));
        for (const std::vector<int>& pair : joined) {
            const int a = nth(order, pair[0]);
            const int b = nth(order, pair[1]);
            nth(nth(full, std::min(a, b)), std::max(a, b)) = 1;
        }
        int count = 0;
        for (std::size_t i = 0; i < full.size(); ++i) {
            std::vector<std::size_t> later;
            for (std::size_t k = i + 1; k < full.size(); ++k) {
                if (full[i][k] != 0) later.push_back(k);
            }
            count += static_cast<int>(later.size());
            for (std::size_t a = 0; a < later.size(); ++a) {
                for (std::size_t b = a + 1; b < later.size(); ++b) full[later[a]][later[b]] = 1;
            }
        }
        return count;
    };
    std::vector<int> as_written(places.size());
    std::iota(as_written.begin(), as_written.end(), 0);
    const std::vector<int> order = plane_order(joined, places);
    std::vector<int> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(sorted, as_written);
    EXPECT_EQ(order, plane_order(joined, places));
    // Row by row, each fills a row: 13 000 in all.
    EXPECT_GT(fill(as_written), 12000);
    EXPECT_LT(fill(order), 8000);
    EXPECT_LT(fill(least_degree_order(joined, side * side)), 8000);
}

}  // namespace
}  // namespace popup::folded
