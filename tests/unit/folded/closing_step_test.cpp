// The smallest step against a complete orthogonal decomposition with more digits, whichever equations it is
// found from.
#include "folded/closing_step.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "base/nth.h"
#include "folded/least_step.h"
#include "folded/plane_order.h"
#include "folded/rigid.h"
#include "folded/sheet.h"
#include "folded/step_plan.h"
#include "folded/work.h"
#include "miura.h"
#include "support/random.h"

namespace popup::folded {
namespace {

using test::Random;
using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

constexpr double kLeastDamping = 1e-13;
constexpr long double kRight = 1e-12L;  // of the step

double between(Random& random, double low, double high) { return low + (high - low) * random.unit(); }

// Loops over angles, their slopes, and what they have to become.
struct StepQuestion {
    std::vector<LoopRow> rows;
    std::vector<int> columns;
    std::vector<ClosingStep::Slope> slopes;
    Eigen::VectorXd ease, change;
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
        for (double& value : question.slopes.back()) value = between(random, -1.0, 1.0);
    }
    row.end = question.columns.size();
    question.rows.push_back(row);
}

void finish(StepQuestion& question, int angles, Random& random) {
    question.ease.resize(angles);
    for (double& value : question.ease) value = between(random, 0.1, 1.0);
    question.change.resize(question.rows.back().first + question.rows.back().count);
    for (double& value : question.change) value = between(random, -1.0, 1.0);
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

// A Miura sheet whose folds have a share of their angles: of its conditions a third follow from the others,
// where it is flat or folded flat more do, and beside that nearly.
StepQuestion miura_at(int columns, int rows, double share, Random& random) {
    Diagnostics diagnostics;
    const Sheet sheet = *make_sheet(test::miura(columns, rows, 20.0, 20.0, 0.5), {}, diagnostics);
    StepQuestion question;
    for (const Loop& loop : sheet.loops) {
        std::vector<int> angles;
        for (const Step& step : loop.steps) angles.push_back(step.fold);
        add_loop(question, angles, 3, random);
        Rigid3 motion;
        for (std::size_t i = 0; i < loop.steps.size(); ++i) {
            const Fold& fold = nth(sheet.folds, loop.steps[i].fold);
            const Segment line = sheet.line_of(fold);
            const Vec2 along = unit(line.b - line.a);
            const Vec3 axis{along.x, along.y, 0.0};
            const Vec3 way = loop.steps[i].sign * motion.direction(axis);
            question.slopes[question.rows.back().begin + i] = {way.x, way.y, way.z};
            motion = motion.after_turn({}, axis, loop.steps[i].sign * share * fold.target);
        }
    }
    finish(question, static_cast<int>(sheet.folds.size()), random);
    return question;
}

// Each loop a second time: all its conditions depend on each other.
StepQuestion twice(StepQuestion question, Random& random) {
    const std::vector<LoopRow> rows = question.rows;
    for (const LoopRow& row : rows) {
        std::vector<int> angles;
        for (std::size_t i = row.begin; i < row.end; ++i) angles.push_back(question.columns[i]);
        add_loop(question, angles, row.count, random);
        for (std::size_t i = row.begin; i < row.end; ++i)
            question.slopes[question.rows.back().begin + (i - row.begin)] = question.slopes[i];
    }
    const auto angles = static_cast<int>(question.ease.size());
    finish(question, angles, random);
    return question;
}

LongMatrix slopes_of(const StepQuestion& question) {
    LongMatrix slopes = LongMatrix::Zero(question.change.size(), question.ease.size());
    for (const LoopRow& row : question.rows) {
        for (std::size_t i = row.begin; i < row.end; ++i) {
            for (int k = 0; k < row.count; ++k)
                slopes(row.first + k, question.columns[i]) += nth(question.slopes[i], k);
        }
    }
    return slopes;
}

// A change that folds can make, as steps near closure ask for.
void make_possible(StepQuestion& question, Random& random) {
    LongVector by(question.ease.size());
    for (long double& value : by) value = between(random, -1.0, 1.0);
    question.change = (slopes_of(question) * by).cast<double>();
}

// The step s = S y of least |c - J S y|² + d |y|².
LongVector by_decomposition(const StepQuestion& question, double damping) {
    const LongVector root = question.ease.cast<long double>().cwiseSqrt();
    const Eigen::Index conditions = question.change.size();
    const Eigen::Index angles = question.ease.size();
    LongMatrix all = LongMatrix::Zero(conditions + angles, angles);
    all.topRows(conditions) = slopes_of(question) * root.asDiagonal();
    all.bottomRows(angles).diagonal().setConstant(std::sqrt(static_cast<long double>(damping)));
    LongVector change = LongVector::Zero(conditions + angles);
    change.head(conditions) = question.change.cast<long double>();
    const Eigen::CompleteOrthogonalDecomposition<LongMatrix> solver(all);
    EXPECT_EQ(solver.rank(), angles);
    return root.cwiseProduct(LongVector(solver.solve(change)));
}

void expect_step(const StepQuestion& question, double damping, const std::string& what) {
    const LongVector expected = by_decomposition(question, damping);
    const long double size = expected.lpNorm<Eigen::Infinity>();
    std::vector<int> order(static_cast<std::size_t>(question.ease.size()));
    std::iota(order.rbegin(), order.rend(), 0);
    for (const bool of_angles : {true, false}) {
        ClosingStep step(question.rows, question.columns, question.ease,
                         of_angles ? order : std::vector<int>{});
        ASSERT_TRUE(step.factorise(question.slopes, damping));
        Eigen::VectorXd by;
        ASSERT_TRUE(step.find(question.slopes, question.change, by));
        EXPECT_LT((by.cast<long double>() - expected).lpNorm<Eigen::Infinity>(), kRight * size)
            << what << (of_angles ? ", by angles" : ", by conditions") << ", damping " << damping;
    }
}

// Far from closure changes are any, and steps are damped.
TEST(ClosingStep, IsRightHoweverItIsDamped) {
    Random random(3);
    for (int i = 0; i < 12; ++i) {
        const StepQuestion tessellation = grid(1 + i % 6, 1 + i % 5, random);
        const StepQuestion holes = rings(1 + i % 4, 24 - i, random);
        const StepQuestion flat = miura_at(3 + i % 3, 3, 0.0, random);
        for (const double damping : {1.0, 1e-3}) {
            expect_step(tessellation, damping, "grid");
            expect_step(holes, damping, "rings");
            expect_step(flat, damping, "flat Miura");
            expect_step(twice(tessellation, random), damping, "grid twice");
        }
    }
}

// Near closure hardly anything but rounding stands in the equations, where no loop opens or where conditions
// depend on each other.
TEST(ClosingStep, IsRightWhereLoopsHardlySayAnything) {
    Random random(4);
    const auto expect = [&](StepQuestion question, const std::string& what) {
        make_possible(question, random);
        expect_step(question, kLeastDamping, what);
    };
    for (int i = 0; i < 10; ++i) {
        expect(grid(2 + i % 5, 1 + i % 4, random), "grid");
        expect(rings(1 + i % 3, 20 - i, random), "rings");
        expect(twice(grid(2 + i % 3, 2, random), random), "grid twice");
        expect(twice(rings(2, 14 - i % 4, random), random), "rings twice");
        const double share = i == 0 ? 0.0 : i == 1 ? 1.0 : random.unit();
        expect(miura_at(3 + i % 4, 3 + i % 3, share, random), "Miura at " + std::to_string(share));
    }
}

// What one solution leaves open, others with the same factors close, as steps do whose slopes are kept. Where
// no loop opens, a thousandth of a step may be left in the solution, which then is as good.
TEST(ClosingStep, OneSolutionLeavesWhatTheNextCorrects) {
    Random random(6);
    for (int i = 0; i < 10; ++i) {
        StepQuestion question = grid(2 + i % 5, 1 + i % 4, random);
        make_possible(question, random);
        const LongVector expected = by_decomposition(question, kLeastDamping);
        std::vector<int> order(static_cast<std::size_t>(question.ease.size()));
        std::iota(order.rbegin(), order.rend(), 0);
        for (const bool of_angles : {true, false}) {
            ClosingStep step(question.rows, question.columns, question.ease,
                             of_angles ? order : std::vector<int>{});
            ASSERT_TRUE(step.factorise(question.slopes, kLeastDamping));
            Eigen::VectorXd all = Eigen::VectorXd::Zero(question.ease.size());
            Eigen::VectorXd by;
            for (int k = 0; k < 4; ++k) {
                const Eigen::VectorXd left = question.change - step.change_by(question.slopes, all);
                ASSERT_EQ(step.find(question.slopes, left, by, 1), 1);
                all += by;
            }
            const Eigen::VectorXd open = question.change - step.change_by(question.slopes, all);
            EXPECT_LT(open.lpNorm<Eigen::Infinity>(), 1e-12 * question.change.lpNorm<Eigen::Infinity>());
            EXPECT_LT((all.cast<long double>() - expected).lpNorm<Eigen::Infinity>(),
                      1e-2L * expected.lpNorm<Eigen::Infinity>());
        }
    }
}

// The same of equations that are not those of loops; steps are found from those of unknowns or of conditions,
// whichever are fewer.
TEST(LeastStep, IsRightWhereEquationsDependOnEachOther) {
    Random random(5);
    const auto expect = [&](StepQuestion question, const std::string& what) {
        question.ease.setOnes();
        make_possible(question, random);
        std::vector<Eigen::Triplet<double>> entries;
        for (const LoopRow& row : question.rows) {
            for (std::size_t k = row.begin; k < row.end; ++k) {
                for (int j = 0; j < row.count; ++j)
                    entries.emplace_back(row.first + j, question.columns[k], nth(question.slopes[k], j));
            }
        }
        Work work;
        LeastStep least;
        const LongVector expected = by_decomposition(question, kLeastDamping);
        // The second question has the order that was found for the first.
        for (const double times : {1.0, -0.5}) {
            const Eigen::VectorXd residual = -times * question.change;
            const auto by = least.find(entries, question.ease.size(), residual, kLeastDamping, work);
            ASSERT_TRUE(by) << what;
            EXPECT_LT((by->cast<long double>() - times * expected).lpNorm<Eigen::Infinity>(),
                      kRight * expected.lpNorm<Eigen::Infinity>())
                << what;
        }
    };
    for (int i = 0; i < 10; ++i) {
        expect(twice(grid(2 + i % 3, 2, random), random), "more conditions");
        expect(rings(1 + i % 3, 20 - i, random), "more unknowns");
        expect(miura_at(3 + i % 4, 3 + i % 3, 0.3, random), "Miura");
    }
}

TEST(LeastStep, LeavesWhatNoSlopeSaysAnythingOf) {
    // Each third unknown has an equation; those of the others are of the regularisation alone.
    constexpr int kEquations = 1'000;
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < kEquations; ++i) {
        entries.emplace_back(2 * i, 3 * i, 1.0);
        entries.emplace_back(2 * i + 1, 3 * i, 1.0);
    }
    Work work;
    const Eigen::VectorXd residual = Eigen::VectorXd::Ones(2 * kEquations);
    const auto by = LeastStep().find(entries, 3 * kEquations, residual, 1e-13, work);
    ASSERT_TRUE(by);
    for (int i = 0; i < kEquations; ++i) {
        ASSERT_NEAR((*by)[3 * i], -1.0, 1e-12) << i;
        ASSERT_EQ((*by)[3 * i + 1], 0.0) << i;
        ASSERT_EQ((*by)[3 * i + 2], 0.0) << i;
    }
}

TEST(LeastStep, IsPaidFor) {
    const std::vector<Eigen::Triplet<double>> entries{{0, 0, 1.0}, {0, 1, 1.0}, {1, 1, 2.0}};
    const Eigen::VectorXd residual = Eigen::VectorXd::Ones(2);
    Work work;
    ASSERT_TRUE(LeastStep().find(entries, 2, residual, 1e-13, work));
    Work enough(work.spent());
    EXPECT_TRUE(LeastStep().find(entries, 2, residual, 1e-13, enough));
    Work little(0.5 * work.spent());
    EXPECT_FALSE(LeastStep().find(entries, 2, residual, 1e-13, little));
}

std::vector<int> all(std::size_t count) {
    std::vector<int> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

StepPlan plan_of(const CreasePattern& pattern, double most) {
    Diagnostics diagnostics;
    const Sheet sheet = *make_sheet(pattern, {}, diagnostics);
    const Work work(most);
    return plan_steps(sheet, all(sheet.folds.size()), all(sheet.loops.size()), work);
}

TEST(StepPlan, OfATessellationIsOfItsAnglesAndGrowsLittle) {
    const auto work_of = [](int side) {
        const StepPlan plan = plan_of(test::miura(side, side, 20.0, 20.0, 0.5), 1e12);
        EXPECT_TRUE(plan.affordable);
        EXPECT_EQ(plan.angle_order.size(), static_cast<std::size_t>(2 * side * (side - 1)));
        return plan.work;
    };
    // That of dense factors grows as the cube of the panels, of banded ones as their square.
    const double growth = std::log(work_of(80) / work_of(20)) / std::log(16.0);
    EXPECT_GT(growth, 1.0);
    EXPECT_LT(growth, 1.4);
}

// A star of n folds is one loop: three conditions, or n angles that all hang together.
TEST(StepPlan, OfALoopOfManyFoldsIsOfItsConditions) {
    CreasePattern star;
    Ring ring;
    for (int i = 0; i < 60; ++i) {
        const double way = 2.0 * std::numbers::pi * i / 60;
        ring.push_back({100.0 * std::cos(way), 100.0 * std::sin(way)});
        star.lines.push_back(
            {{{0, 0}, ring.back()}, false, i % 2 == 0 ? CreaseUse::mountain : CreaseUse::valley});
    }
    star.lines.push_back({ring, true, CreaseUse::cut});
    const StepPlan plan = plan_of(star, 1e12);
    EXPECT_TRUE(plan.affordable);
    EXPECT_TRUE(plan.angle_order.empty());
    EXPECT_EQ(plan.loops, std::vector<int>{0});
    EXPECT_FALSE(plan_of(star, 50.0 * plan.work).affordable);
    EXPECT_TRUE(plan_of(star, 100.0 * plan.work).affordable);
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
    const std::vector<int> as_written = all(places.size());
    const std::vector<int> order = plane_order(joined, places);
    std::vector<int> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    EXPECT_EQ(sorted, as_written);
    EXPECT_EQ(order, plane_order(joined, places));
    // Row by row, each fills a row: 13 000 in all.
    EXPECT_GT(fill(as_written), 12000);
    EXPECT_LT(fill(order), 8000);
}

}  // namespace
}  // namespace popup::folded
