// What an editor waits for: a document of 1000 elements, a keystroke, and what comes of it.
#include <benchmark/benchmark.h>

#include <string>

#include "lsp/server.h"
#include "output/xml.h"
#include "support/designs.h"

namespace popup::lsp {
namespace {

constexpr int kElements = 1000;
constexpr double kScale = 0.8;  // so that they fit on a page

AnalysisOptions options() { return {{}, {}, find_language({}, "xml")}; }

// The findings of reading and checking, which come with each keystroke.
void BM_Check(benchmark::State& state) {
    const Source source{"card.xml", write_document(test::row(kElements, kScale))};
    for (auto _ : state) benchmark::DoNotOptimize(analyse(source, options(), Depth::check));
}
BENCHMARK(BM_Check)->Unit(benchmark::kMillisecond);

// The same with the motion, which is examined when nothing has been typed for a while.
void BM_Whole(benchmark::State& state) {
    const Source source{"card.xml", write_document(test::row(kElements, kScale))};
    for (auto _ : state) benchmark::DoNotOptimize(analyse(source, options(), Depth::whole));
}
BENCHMARK(BM_Whole)->Unit(benchmark::kMillisecond);

// The check, and what has changed of the motion. A function of its own, so that a profiler can be asked for
// it.
[[gnu::noinline]] Analysis keystroke(const Source& source, const AnalysisOptions& whole) {
    const Analysis checked = analyse(source, options(), Depth::check);
    return analyse(source, whole, Depth::whole, checked.stages);
}

// A keystroke in a document whose motion has been examined before.
void BM_Keystroke(benchmark::State& state) {
    Source source{"card.xml", write_document(test::row(kElements, kScale))};
    ExaminationMemory memory;
    AnalysisOptions whole = options();
    whole.compile.motion.memory = &memory;
    analyse(source, whole, Depth::whole);
    // The last digit of a point in the middle, up and down.
    const std::size_t at =
        source.text.find("\"", source.text.find("<point x=", source.text.size() / 2) + 12) - 1;
    bool up = false;
    for (auto _ : state) {
        source.text[at] = (up = !up) ? '1' : '2';
        benchmark::DoNotOptimize(keystroke(source, whole));
    }
    state.counters["pairs"] = static_cast<double>(memory.share().pairs);
    state.counters["examined"] = static_cast<double>(memory.share().examined_pairs);
}
BENCHMARK(BM_Keystroke)->Unit(benchmark::kMillisecond);

// Answers in the middle of typing, from the text as it is.
template <typename Ask>
void ask(benchmark::State& state, const Ask& question) {
    const Source source{"card.xml", write_document(test::row(kElements, kScale))};
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
// The first in a text that has changed.
void BM_FirstHover(benchmark::State& state) {
    const Source source{"card.xml", write_document(test::row(kElements, kScale))};
    Analysis analysis = analyse(source, options(), Depth::check);
    const Text text(source.text);
    const std::size_t at = source.text.find("<structure ", source.text.size() / 2) + 4;
    for (auto _ : state) {
        analysis.card = std::make_shared<CardOnce>();
        const View view{text, source.name, &analysis, &analysis};
        benchmark::DoNotOptimize(find_service("xml")->hover(view, at));
    }
}
BENCHMARK(BM_FirstHover)->Unit(benchmark::kMillisecond);
void BM_Complete(benchmark::State& state) {
    ask(state, [](const Service& service, const View& view, std::size_t at) {
        benchmark::DoNotOptimize(service.complete(view, at));
    });
}
BENCHMARK(BM_Complete)->Unit(benchmark::kMillisecond);
void BM_Definition(benchmark::State& state) {
    ask(state, [](const Service& service, const View& view, std::size_t at) {
        benchmark::DoNotOptimize(service.definition(view, at));
    });
}
BENCHMARK(BM_Definition)->Unit(benchmark::kMillisecond);
void BM_Symbols(benchmark::State& state) {
    ask(state, [](const Service& service, const View& view, std::size_t /*at*/) {
        benchmark::DoNotOptimize(service.symbols(view));
    });
}
BENCHMARK(BM_Symbols)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace popup::lsp

BENCHMARK_MAIN();
