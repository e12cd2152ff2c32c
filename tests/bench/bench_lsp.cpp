// What an editor waits for: a document of 1000 elements, a keystroke, and what comes of it.
#include <benchmark/benchmark.h>

#include <string>

#include "lsp/server.h"
#include "output/xml.h"
#include "support/designs.h"

namespace popup::lsp {
namespace {

constexpr int kElements = 1000;

AnalysisOptions options() { return {{}, {}, find_language({}, "xml")}; }

// The findings of reading and checking, which come with each keystroke.
void BM_Check(benchmark::State& state) {
    const Source source{"card.xml", write_document(test::row(kElements))};
    for (auto _ : state) benchmark::DoNotOptimize(analyse(source, options(), Depth::check));
}
BENCHMARK(BM_Check)->Unit(benchmark::kMillisecond);

// The same with the motion, which is examined when nothing has been typed for a while.
void BM_Whole(benchmark::State& state) {
    const Source source{"card.xml", write_document(test::row(kElements))};
    for (auto _ : state) benchmark::DoNotOptimize(analyse(source, options(), Depth::whole));
}
BENCHMARK(BM_Whole)->Unit(benchmark::kMillisecond);

// Answers in the middle of typing, from the text as it is.
template <typename Ask>
void ask(benchmark::State& state, const Ask& question) {
    const Source source{"card.xml", write_document(test::row(kElements))};
    const Analysis analysis = analyse(source, options(), Depth::check);
    const Text text(source.text);
    const View view{text, source.name, &analysis, &analysis};
    const std::size_t at = source.text.find("<structure ", source.text.size() / 2) + 4;
    for (auto _ : state) question(*find_service("xml"), view, at);
}
void BM_Hover(benchmark::State& state) {
    ask(state, [](const Service& service, const View& view, std::size_t at) {
        benchmark::DoNotOptimize(service.hover(view, at));
    });
}
BENCHMARK(BM_Hover)->Unit(benchmark::kMillisecond);
void BM_Complete(benchmark::State& state) {
    ask(state, [](const Service& service, const View& view, std::size_t at) {
        benchmark::DoNotOptimize(service.complete(view, at));
    });
}
BENCHMARK(BM_Complete)->Unit(benchmark::kMillisecond);
void BM_Symbols(benchmark::State& state) {
    ask(state, [](const Service& service, const View& view, std::size_t /*at*/) {
        benchmark::DoNotOptimize(service.symbols(view));
    });
}
BENCHMARK(BM_Symbols)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace popup::lsp

BENCHMARK_MAIN();
