// What it costs to know that nothing collides: pairs certified a second, cost against plates, and the ratio
// to brute force, all in one run.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <map>

#include "popup/compile.h"
#include "support/brute_force.h"
#include "support/designs.h"

namespace popup::test {
namespace {

const Assembly& long_card(int plates) {
    static std::map<int, Assembly> made;
    const auto [it, fresh] = made.try_emplace(plates);
    if (fresh) it->second = *build(row(plates / 2)).assembly;
    return it->second;
}

struct Cost {
    double seconds = 0.0;
    Examination found;
};
std::map<int, Cost> costs;  // by plates

void examine_plates(benchmark::State& state) {
    const auto plates = static_cast<int>(state.range(0));
    const Assembly& assembly = long_card(plates);
    Cost& cost = costs[plates];
    double seconds = 0.0;
    for (auto _ : state) {
        const auto start = std::chrono::steady_clock::now();
        cost.found = examine(assembly, {});
        seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }
    POPUP_INVARIANT(cost.found.contacts.empty() && cost.found.undecided.empty());
    cost.seconds = seconds / static_cast<double>(state.iterations());
    state.counters["pairs/s"] = static_cast<double>(cost.found.pairs) / cost.seconds;
}
BENCHMARK(examine_plates)
    ->Arg(100)
    ->Arg(300)
    ->Arg(1000)
    ->Arg(3000)
    ->Arg(10000)
    ->Unit(benchmark::kMillisecond);

// The largest way any corner goes in one degree, anywhere in the motion: what brute force must step by to be
// sure.
double fastest_mm_per_deg(const Assembly& assembly) {
    std::vector<Frame> here(assembly.plates.size());
    std::vector<Frame> there(assembly.plates.size());
    double fastest = 0.0;
    constexpr double kStep = 0.1;
    POPUP_INVARIANT(place(assembly, Angle::degrees(0.0), here));
    for (int i = 1; i <= 1800; ++i) {
        POPUP_INVARIANT(place(assembly, Angle::degrees(i * kStep), there));
        for (std::size_t k = 0; k < here.size(); ++k) {
            for (const Vec2 p : assembly.plates[k].outline.outer) {
                fastest = std::max(fastest, distance(here[k].point(p), there[k].point(p)) / kStep);
            }
        }
        std::swap(here, there);
    }
    return fastest;
}

void report() {
    fmt::print(
        "\n| plates | ms | ms a 1000 plates | pairs of plates | pairs certified a second | poses a pair |\n");
    fmt::print("|---|---|---|---|---|---|\n");
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    for (const auto& [plates, cost] : costs) {
        fmt::print("| {} | {:.1f} | {:.0f} | {} | {:.0f} | {:.2f} |\n", plates, 1e3 * cost.seconds,
                   1e6 * cost.seconds / plates, cost.found.pairs,
                   static_cast<double>(cost.found.pairs) / cost.seconds,
                   static_cast<double>(cost.found.poses) / static_cast<double>(cost.found.pairs));
        const double x = std::log(plates);
        const double y = std::log(cost.seconds);
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
    }
    const auto n = static_cast<double>(costs.size());
    if (costs.size() > 1)
        fmt::print("\ncost grows as plates^{:.2f}\n", (n * sxy - sx * sy) / (n * sxx - sx * sx));

    if (!BruteForce::available()) {
        fmt::print("{}\n", BruteForce::kMissing);
        return;
    }
    Diagnostics diagnostics;
    const auto source = read_source(std::string(POPUP_SOURCE_DIR) + "/samples/creature.xml", diagnostics);
    const auto creature =
        assemble(*check(*read_design(*source, {}, diagnostics), {}, diagnostics), {}, diagnostics);
    const auto seconds = [](const auto& what, int times) {
        const auto start = std::chrono::steady_clock::now();
        for (int i = 0; i < times; ++i) what(i);
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / times;
    };
    const double ours = seconds([&](int) { benchmark::DoNotOptimize(examine(*creature, {})); }, 20);
    const BruteForce brute(*creature);
    const double a_pose =
        seconds([&](int i) { benchmark::DoNotOptimize(brute.crossing_at(0.9 * (i + 0.5))); }, 200);
    // As certain of what is 0.01 mm deep: no point may go further than that between two poses.
    const double step = 0.01 / fastest_mm_per_deg(*creature);
    fmt::print(
        "26-element sample: every angle in {:.1f} ms. Brute force takes {:.2f} ms a pose: {:.1f} s at 0.05° "
        "({:.0f} "
        "times as long, and sure of nothing in between); to be as sure, at {:.5f}°, {:.0f} s ({:.0f} "
        "times)\n",
        1e3 * ours, 1e3 * a_pose, 3600 * a_pose, 3600 * a_pose / ours, step, 180.0 / step * a_pose,
        180.0 / step * a_pose / ours);
}

}  // namespace
}  // namespace popup::test

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    popup::test::report();
    return 0;
}
