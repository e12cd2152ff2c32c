// What an assembly book costs: of a card of twelve pieces, against its compile and one of its pictures.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <map>
#include <string>

#include "popup/compile.h"
#include "popup/gluing.h"
#include "support/designs.h"

namespace popup::test {
namespace {

Source village() {
    Diagnostics diagnostics;
    auto source = read_source(std::string(POPUP_SOURCE_DIR) + "/samples/tent-village.xml", diagnostics);
    POPUP_INVARIANT(source.has_value());
    return *source;
}

// Keeps what each benchmark took, for the table.
class Keeper : public benchmark::ConsoleReporter {
 public:
    void ReportRuns(const std::vector<Run>& runs) override {
        ConsoleReporter::ReportRuns(runs);
        for (const Run& run : runs) cpu_ms[run.benchmark_name()] = run.GetAdjustedCPUTime();
    }
    std::map<std::string, double> cpu_ms;
};

Compilation compiled() {
    const CompileOptions options;
    return compile({village()}, options, {});
}

std::string written(const RunPage& page, const char* format) {
    Diagnostics diagnostics;
    return *std::get<PageWriter>(find_format(format)->write)(page, {}, diagnostics);
}

}  // namespace
}  // namespace popup::test

int main(int argc, char** argv) {
    using namespace popup;
    using namespace popup::test;
    benchmark::Initialize(&argc, argv);
    const Compilation run = compiled();
    const CompiledDesign& one = run.designs.front();
    const SceneCard card{&*one.assembly, &*one.motion, "", nullptr, &*one.pattern};
    const RunPage page{{&card, 1}, &*run.layout, {}, false};
    const auto add = [](const char* name, const auto& work) {
        benchmark::RegisterBenchmark(name, [&work](benchmark::State& state) {
            for (auto _ : state) benchmark::DoNotOptimize(work());
        })->Unit(benchmark::kMillisecond);
    };
    const auto whole = [] { return compiled().layout.has_value(); };
    const auto order = [&] { return gluing_order(*one.assembly).steps.size(); };
    const auto still = [&] {
        Diagnostics diagnostics;
        OutputOptions options;
        options.still.size = PictureSize{500, 333};
        return std::get<StillWriter>(find_format(".view.png")->write)({&card, 1}, options, diagnostics)
            ->size();
    };
    const auto pdf = [&] { return written(page, ".book.pdf").size(); };
    const auto html = [&] { return written(page, ".book.html").size(); };
    add("compile", whole);
    add("order", order);
    add("still", still);
    add(".book.pdf", pdf);
    add(".book.html", html);
    Keeper keeper;
    benchmark::RunSpecifiedBenchmarks(&keeper);
    fmt::print("\n| {} pieces | ms of CPU | of its compile |\n|---|---|---|\n", one.assembly->pieces.size());
    for (const char* name : {"compile", "order", "still", ".book.pdf", ".book.html"})
        fmt::print("| {} | {:.2f} | {:.2f} |\n", name, keeper.cpu_ms[name],
                   keeper.cpu_ms[name] / keeper.cpu_ms["compile"]);
}
