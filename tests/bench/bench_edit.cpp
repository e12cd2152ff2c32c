// What an edit costs in a document of 1000 elements: by command, of elements that share the gutter, and of
// elements that stand on each other.
#include <benchmark/benchmark.h>

#include <string>

#include "output/xml.h"
#include "popup/edit.h"
#include "support/designs.h"

namespace popup {
namespace {

constexpr int kElements = 1000;
constexpr double kScale = 0.8;  // so that they fit on a page

// Tents in a row, all on the gutter.
Source tents() {
    constexpr double kPitch = 8.0;
    const double height = kPitch * kElements;
    Design design = test::card(200.0, height);
    for (int i = 0; i < kElements; ++i) {
        const double y = -0.5 * height + kPitch * i + 1.0;
        test::add(design, "tent",
                  {{-20, y}, {-20, y + 5}, {20, y}, {20, y + 5}, {-30, 0}, {-30, 5}, {30, 0}, {30, 5}},
                  {0, -0.5 * height}, {0, 0.5 * height});
    }
    return {"tents.xml", write_document(design)};
}

Source mixed() { return {"row.xml", write_document(test::row(kElements, kScale))}; }

void edit(benchmark::State& state, const Source& source, const std::string& line) {
    Diagnostics trouble("edits.txt");
    const std::vector<EditLine> edits = read_edits(line, trouble);
    for (auto _ : state) {
        Diagnostics of_edits("edits.txt");
        Diagnostics of_document(source.name);
        const auto edited = edit_document(source, edits, {}, of_edits, of_document);
        if (!edited || edited->refused) state.SkipWithError("the edit is not carried out");
        state.counters["findings"] = static_cast<double>(of_document.sorted().size());
        benchmark::DoNotOptimize(edited);
    }
}

// Tents on the gutter.
void BM_Tents(benchmark::State& state, const char* line) { edit(state, tents(), line); }
BENCHMARK_CAPTURE(BM_Tents, delete, "delete e500")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Tents, set, "set e500 --width 44")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Tents, color, "set e500 --left-color gold")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Tents, move, "move e500 --along 0.5")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Tents, follow, "move e500 --along 0.5 --follow")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Tents, point, "point e500.G --by 0,0.5 --alone")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Tents, points, "point e500.A --by 0,0.5")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Tents, copy, "copy e500 --step 0.1")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Tents, add, "add tent --id new --on gutter --at 2 --length 1 --width 30 --height 12")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Tents, outline, "outline e500 --d 'M -30,0 H 30 V 5 H 10 V 3 H -10 V 5 H -30 Z'")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Tents, rename, "rename e500 other")->Unit(benchmark::kMillisecond);

// Elements of several kinds, many of them on each other.
void BM_Mixed(benchmark::State& state, const char* line) { edit(state, mixed(), line); }
BENCHMARK_CAPTURE(BM_Mixed, delete, "delete e500")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Mixed, set, "set e500 --height 5")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Mixed, follow, "move e499 --along 0.5 --follow")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Mixed, point, "point e500.G --by 0,0.5")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Mixed, copy, "copy e499 --step 0.5")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Mixed, add, "add tent --id new --on gutter --at 2 --length 1 --width 10 --height 4")
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(BM_Mixed, rename, "rename e499 other")->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace popup

BENCHMARK_MAIN();
