// What a pose of an element costs, kind of joint by kind of joint, and how the cost of a card grows with the
// planes that are attached to it. Ends with tables of ratios, all of one run.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "popup/check.h"
#include "popup/motion.h"
#include "popup/pattern.h"
#include "support/designs.h"

namespace popup::test {
namespace {

constexpr double kPitchMm = 40.0;
constexpr int kElements = 1000;

// Elements of one type beside one another along the gutter; nothing of them collides.
Design row_of(const std::string& type, int elements) {
    Design design = card(400.0, kPitchMm * (elements + 1));
    design.version = "3.0";
    const ElementInfo& info = *find_element(type);
    const auto give = [&info](Structure& made, std::string_view name, Argument value) {
        made.argument(*find_parameter(info, name)) = std::move(value);
    };
    const double seam = std::hypot(9.0, 9.0);
    const Vec2 apex{0.0, -12.0};
    const Vec2 g = apex + Vec2{-seam * std::sin(1.05), seam * std::cos(1.05)};
    const Vec2 h{-g.x, g.y};
    for (int i = 0; i < elements; ++i) {
        const double y = kPitchMm * (i + 0.5) - 0.5 * design.height_mm + 0.5 * kPitchMm;
        std::vector<Vec2> points{{-10, y - 12}, {-10, y + 12}, {10, y - 12}, {10, y + 12}};
        if (type == "v-fold") points = {{-9, y + 9}, {0, y}, {9, y + 9}, g, apex, h, {8, 20}, {-8, 20}};
        if (type == "tent" || type == "layer") {
            const double w = type == "tent" ? 12.0 : 10.0;
            points.insert(points.end(), {{-w, -12}, {-w, 12}, {w, -12}, {w, 12}});
        }
        if (type == "attached-plane") points = {{20, y - 5}, {20, y + 5}, {0, -5}, {0, 5}};
        Structure& made = add(design, type, points);
        if (find_parameter(info, "height")) {
            Argument height;
            height.value = 15.0;
            give(made, "height", height);
        }
        if (type != "attached-plane") continue;
        give(made, "outline", path_argument("M -8 -10 H 20 L 8 12 Z"));
        made.plate.emplace();
        made.plate->at.at = {20.0, y};
    }
    return design;
}

Assembly assembled(const Design& design) {
    Diagnostics diagnostics;
    const auto checked = check(design, {}, diagnostics);
    if (diagnostics.has_findings()) fmt::print(stderr, "{}", findings(diagnostics));
    POPUP_INVARIANT(checked && !diagnostics.has_findings());
    return *assemble(*checked, {}, diagnostics);
}

class Keeper : public benchmark::ConsoleReporter {
 public:
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs) cpu_ns[run.run_name.function_name] = run.GetAdjustedCPUTime();
        ConsoleReporter::ReportRuns(runs);
    }
    std::map<std::string, double> cpu_ns;
};

const std::vector<std::string> kTypes{"v-fold", "tent", "layer", "box", "floating-layer", "attached-plane"};
const std::vector<int> kSizes{100, 1000, 10000};

void pose(benchmark::State& state, const Assembly& assembly) {
    std::vector<Frame> frames(assembly.plates.size());
    double deg = 0.0;
    for (auto _ : state) {
        deg = deg > 170.0 ? 1.0 : deg + 7.3;
        benchmark::DoNotOptimize(place(assembly, Angle::degrees(deg), frames));
    }
}

void whole_card(benchmark::State& state, const Design& design) {
    for (auto _ : state) {
        Diagnostics diagnostics;
        const Assembly assembly = assembled(design);
        benchmark::DoNotOptimize(simulate(assembly, {}, diagnostics));
        benchmark::DoNotOptimize(make_pattern(assembly, {}, diagnostics));
    }
}

}  // namespace
}  // namespace popup::test

int main(int argc, char** argv) {
    using namespace popup;
    using namespace popup::test;
    benchmark::Initialize(&argc, argv);
    std::map<std::string, Assembly> assemblies;
    for (const std::string& type : kTypes) {
        const Assembly& made = assemblies[type] = assembled(row_of(type, kElements));
        benchmark::RegisterBenchmark(("pose/" + type).c_str(),
                                     [&made](benchmark::State& state) { pose(state, made); });
    }
    for (const int size : kSizes) {
        benchmark::RegisterBenchmark(
            fmt::format("attached planes {}", size).c_str(),
            [size](benchmark::State& state) { whole_card(state, row_of("attached-plane", size)); });
    }
    Keeper keeper;
    benchmark::RunSpecifiedBenchmarks(&keeper);
    fmt::print(
        "\n| element | ns a pose | plates | of a v-fold's, an element | a plate |\n|---|---|---|---|---|\n");
    const double base = keeper.cpu_ns["pose/v-fold"] / kElements;
    for (const std::string& type : kTypes) {
        const double ns = keeper.cpu_ns["pose/" + type] / kElements;
        const auto plates = static_cast<double>(assemblies[type].plates.size() - 2) / kElements;
        fmt::print("| {} | {:.0f} | {:.0f} | {:.2f} | {:.2f} |\n", type, ns, plates, ns / base,
                   ns / base * 2.0 / plates);
    }
    fmt::print(
        "\n| attached planes, check to pattern with examination | a plane, relative to 1000 |\n|---|---|\n");
    for (const int size : kSizes) {
        const auto of = [&](int n) { return keeper.cpu_ns[fmt::format("attached planes {}", n)] / n; };
        fmt::print("| {} | {:.2f} |\n", size, of(size) / of(1000));
    }
}
