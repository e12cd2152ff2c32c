// What a state of a folded sheet costs, beside a plain dense Newton iteration, and how the cost of a sheet
// grows; and what cartons of forty panels cost until they are closed. Ends with tables, all of one run.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "../unit/folded/miura.h"
#include "folded/closure.h"
#include "folded/rigid.h"
#include "folded/sheet.h"
#include "folded/work.h"
#include "popup/edit_drawing.h"
#include "popup/language.h"
#include "popup/motion.h"
#include "popup/refinement.h"
#include "support/dielines.h"

namespace popup::test {
namespace {

// Panels along a side, and the largest at which the dense iteration and the whole motion are asked as well.
const std::vector<int> kSides{6, 13, 26, 50, 100};
constexpr int kLargestDense = 26;
constexpr int kLargestWhole = 26;
constexpr double kShare = 0.5;
constexpr double kEnough = 1e-12;  // residual
constexpr int kMostSteps = 60;

CreasePattern pattern_of(int side) { return miura(side, side, 20.0, 20.0, 0.5); }

std::vector<int> all(std::size_t count) {
    std::vector<int> numbers(count);
    std::iota(numbers.begin(), numbers.end(), 0);
    return numbers;
}

// Where each fold has its share of its final angle.
Eigen::VectorXd guess(const folded::Sheet& sheet) {
    Eigen::VectorXd angles(static_cast<Eigen::Index>(sheet.folds.size()));
    for (std::size_t i = 0; i < sheet.folds.size(); ++i)
        angles[static_cast<Eigen::Index>(i)] = kShare * sheet.folds[i].target;
    return angles;
}

// The same conditions, three a corner, with a full matrix: what one writes first.
class DenseNewton {
 public:
    explicit DenseNewton(const folded::Sheet& sheet) : sheet_(sheet) {
        const auto rows = static_cast<Eigen::Index>(3 * sheet.loops.size());
        residual_.resize(rows);
        slopes_.resize(rows, static_cast<Eigen::Index>(sheet.folds.size()));
    }

    double approach(Eigen::VectorXd& angles) {
        for (int i = 0; i < kMostSteps; ++i) {
            evaluate(angles);
            if (residual_.lpNorm<Eigen::Infinity>() <= kEnough) break;
            Eigen::MatrixXd normal = slopes_ * slopes_.transpose();
            const double mean_square = residual_.squaredNorm() / static_cast<double>(residual_.size());
            normal.diagonal().array() += 1e-13 + 10.0 * mean_square;
            angles -= slopes_.transpose() * normal.ldlt().solve(residual_);
        }
        return residual_.lpNorm<Eigen::Infinity>();
    }

 private:
    void evaluate(const Eigen::VectorXd& angles) {
        slopes_.setZero();
        Eigen::Index row = 0;
        for (const folded::Loop& loop : sheet_.loops) {
            folded::Rigid3 motion;
            for (const folded::Step& step : loop.steps) {
                const Segment line = sheet_.line_of(sheet_.folds[static_cast<std::size_t>(step.fold)]);
                const Vec2 along = unit(line.b - line.a);
                const Vec3 axis{along.x, along.y, 0.0};
                const Vec3 way = step.sign * motion.direction(axis);
                slopes_.col(step.fold).segment<3>(row) << way.x, way.y, way.z;
                motion = motion.after_turn({}, axis, step.sign * angles[step.fold]);
            }
            const Vec3 turn = folded::turn_of(motion);
            residual_.segment<3>(row) << turn.x, turn.y, turn.z;
            row += 3;
        }
    }

    const folded::Sheet& sheet_;
    Eigen::VectorXd residual_;
    Eigen::MatrixXd slopes_;
};

// Keeps what was measured, in ms of CPU.
class Keeper : public benchmark::ConsoleReporter {
 public:
    void ReportRuns(const std::vector<Run>& runs) override {
        ConsoleReporter::ReportRuns(runs);
        for (const Run& run : runs)
            cpu_ms[run.run_name.str()] = 1e3 * run.cpu_accumulated_time / static_cast<double>(run.iterations);
    }
    std::map<std::string, double> cpu_ms;
};

template <typename Newton>
void state_of(benchmark::State& state, const folded::Sheet& sheet, Newton&& newton) {
    double residual = 0.0;
    for (auto _ : state) {
        Eigen::VectorXd angles = guess(sheet);
        residual = newton(angles);
    }
    state.counters["residual"] = residual;
}

void whole_sheet(benchmark::State& state, const CreasePattern& pattern) {
    for (auto _ : state) {
        Diagnostics diagnostics;
        const std::optional<Assembly> assembly = fold_sheet(pattern, {}, diagnostics);
        benchmark::DoNotOptimize(simulate(*assembly, {}, diagnostics));
    }
}

// Of cartons: suggestions, and all that "suggest --accept all" does to close them and see them move.
const std::map<std::string, std::string> kCartons{{"a pointed tube of 40 panels", pointed_tube(13)},
                                                  {"a locked tube of 41", locked_tube(8)},
                                                  {"a locked tray of 42", locked_tray()}};

CreasePattern carton_of(const std::string& drawing) {
    Diagnostics diagnostics("box.svg");
    ReadOptions options;
    options.drawing.as = DrawnAs::folded;
    return *read_source_text({"box.svg", drawing}, options, diagnostics).creases;
}

void suggestions_of(benchmark::State& state, const std::string& drawing) {
    for (auto _ : state) {
        Diagnostics diagnostics;
        benchmark::DoNotOptimize(suggest_joins(carton_of(drawing), {}, diagnostics));
    }
}

void closed_carton(benchmark::State& state, const std::string& drawing) {
    for (auto _ : state) {
        Diagnostics diagnostics;
        const CreasePattern pattern = carton_of(drawing);
        const auto found = suggest_joins(pattern, {}, diagnostics);
        const auto crossings = [](const CreasePattern& refined, bool whole_way) {
            return crossings_in(refined, whole_way, {}, {});
        };
        const auto joins = accept_joins(pattern, {}, *found, "all", {true, crossings}, diagnostics);
        const auto refined = refine_shape(pattern, {{}, *joins}, diagnostics);
        std::optional<Assembly> box = fold_sheet(refined->pattern, {}, diagnostics);
        benchmark::DoNotOptimize(simulate_sheet(*box, {}, diagnostics));
    }
}

}  // namespace
}  // namespace popup::test

int main(int argc, char** argv) {
    using namespace popup;
    using namespace popup::test;
    benchmark::Initialize(&argc, argv);
    std::map<int, folded::Sheet> sheets;
    for (const int side : kSides) {
        Diagnostics diagnostics;
        const folded::Sheet& sheet = sheets[side] = *folded::make_sheet(pattern_of(side), {}, diagnostics);
        const auto add = [&](const std::string& name, auto run) {
            benchmark::RegisterBenchmark(fmt::format("{}/{}", name, side).c_str(), run)
                ->Unit(benchmark::kMillisecond);
        };
        add("state", [&sheet](benchmark::State& state) {
            folded::Work work(HUGE_VAL);
            folded::Closure closure(sheet, all(sheet.folds.size()), all(sheet.loops.size()), work);
            state_of(state, sheet,
                     [&](Eigen::VectorXd& angles) { return closure.approach(angles, kEnough); });
        });
        if (side <= kLargestDense) {
            add("dense", [&sheet](benchmark::State& state) {
                DenseNewton newton(sheet);
                state_of(state, sheet, [&](Eigen::VectorXd& angles) { return newton.approach(angles); });
            });
        }
        if (side <= kLargestWhole)
            add("whole", [side](benchmark::State& state) { whole_sheet(state, pattern_of(side)); });
    }
    for (const auto& [name, drawing] : kCartons) {
        benchmark::RegisterBenchmark(("suggestions/" + name).c_str(), suggestions_of, drawing)
            ->Unit(benchmark::kMillisecond);
        benchmark::RegisterBenchmark(("closed/" + name).c_str(), closed_carton, drawing)
            ->Unit(benchmark::kMillisecond);
    }
    Keeper keeper;
    benchmark::RunSpecifiedBenchmarks(&keeper);
    const auto ms = [&](const std::string& name, int side) {
        return keeper.cpu_ms[fmt::format("{}/{}", name, side)];
    };
    const auto per_panel = [&](const std::string& name, int side) {
        const int base = kSides.front();
        return ms(name, side) / ms(name, base) * base * base / (side * side);
    };
    fmt::print(
        "\n| Miura sheet | folds | a state, ms | a panel, of the smallest's | a dense Newton's, times as "
        "long "
        "| folded and examined, ms | a panel, of the smallest's |\n|---|---|---|---|---|---|---|\n");
    for (const int side : kSides) {
        fmt::print("| {0} × {0} | {1} | {2:.2f} | {3:.1f} | {4} | {5} |\n", side, sheets[side].folds.size(),
                   ms("state", side), per_panel("state", side),
                   side > kLargestDense ? "" : fmt::format("{:.1f}", ms("dense", side) / ms("state", side)),
                   side > kLargestWhole
                       ? " | "
                       : fmt::format("{:.0f} | {:.1f}", ms("whole", side), per_panel("whole", side)));
    }
    fmt::print("\n| Carton | suggestions, ms | all accepted, closed and examined, ms |\n|---|---|---|\n");
    for (const auto& [name, drawing] : kCartons) {
        fmt::print("| {} | {:.0f} | {:.0f} |\n", name, keeper.cpu_ms["suggestions/" + name],
                   keeper.cpu_ms["closed/" + name]);
    }
}
