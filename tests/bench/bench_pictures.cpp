// What a card of 40 pieces of all kinds with ten pictures costs, to PDF and GLB, against decoding its
// pictures. Ends with a table, all of one run.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <map>
#include <string>
#include <vector>

#include "popup/compile.h"
#include "popup/image.h"
#include "support/picture_card.h"

namespace popup::test {
namespace {

// Keeps what each benchmark took, for the table.
class Keeper : public benchmark::ConsoleReporter {
 public:
    void ReportRuns(const std::vector<Run>& runs) override {
        ConsoleReporter::ReportRuns(runs);
        for (const Run& run : runs) cpu_ms[run.benchmark_name()] = run.GetAdjustedCPUTime();
    }
    std::map<std::string, double> cpu_ms;
};

template <class Writer>
auto write_with(const char* suffix) {
    return std::get<Writer>(find_format(suffix)->write);
}

Source card() { return {"card.xml", picture_card()}; }

// All pictures, decoded once.
void decoding(benchmark::State& state) {
    std::vector<std::string> files;
    for (int n = 1; n <= kCardPictures; ++n) files.push_back(card_picture(n));
    for (auto _ : state) {
        for (const std::string& file : files) benchmark::DoNotOptimize(open_image(file));
    }
}

void whole(benchmark::State& state) {
    const Source source = card();
    const CompileOptions options = picture_card_options();
    for (auto _ : state) {
        const Compilation c = compile({source}, options, {});
        POPUP_INVARIANT(c.layout && !c.has_errors());
        Diagnostics diagnostics;
        const SceneCard scene{&*c.designs[0].assembly, &*c.designs[0].motion, ""};
        benchmark::DoNotOptimize(write_with<SheetWriter>(".pdf")(*c.layout, {}, diagnostics));
        benchmark::DoNotOptimize(write_with<SceneWriter>(".glb")({&scene, 1}, {}, diagnostics));
    }
}

// As far as that stage; pictures are decoded to read the document.
void until(benchmark::State& state, Stage stage) {
    const Source source = card();
    CompileOptions options = picture_card_options();
    options.until = stage;
    for (auto _ : state) benchmark::DoNotOptimize(compile({source}, options, {}));
}

template <class Write>
void writing(benchmark::State& state, Write write) {
    const Compilation c = compile({card()}, picture_card_options(), {});
    for (auto _ : state) benchmark::DoNotOptimize(write(c));
}

void print_table(const Keeper& keeper) {
    const auto ms = [&](const char* name) {
        const auto found = keeper.cpu_ms.find(name);
        return found == keeper.cpu_ms.end() ? 0.0 : found->second;
    };
    if (ms("decoding") <= 0.0 || ms("to PDF and GLB") <= 0.0) return;
    fmt::print(
        "\nA card of {} pieces with {} pictures to PDF and GLB: {:.0f} ms, of which {:.1f} ms are to decode "
        "the "
        "pictures once; beside that {:.0f} ms, {:.1f} times as much\n\n| part | ms |\n|---|---|\n",
        kCardPieces, kCardPictures, ms("to PDF and GLB"), ms("decoding"),
        ms("to PDF and GLB") - ms("decoding"), (ms("to PDF and GLB") - ms("decoding")) / ms("decoding"));
    const auto row = [&](const char* part, double value) { fmt::print("| {} | {:.1f} |\n", part, value); };
    row("decoding", ms("decoding"));
    row("reading, beside decoding", ms("until/design") - ms("decoding"));
    row("check and assembly", ms("until/assembly") - ms("until/design"));
    row("examination", ms("until/motion") - ms("until/assembly"));
    row("pattern", ms("until/pattern") - ms("until/motion"));
    row("layout", ms("until/layout") - ms("until/pattern"));
    row("PDF", ms("writing/.pdf"));
    row("GLB", ms("writing/.glb"));
}

}  // namespace
}  // namespace popup::test

int main(int argc, char** argv) {
    using namespace popup;
    using namespace popup::test;
    benchmark::Initialize(&argc, argv);
    const auto add = [](const char* name, auto&&... run) {
        benchmark::RegisterBenchmark(name, run...)->Unit(benchmark::kMillisecond);
    };
    add("decoding", decoding);
    add("to PDF and GLB", whole);
    add("until/design", until, Stage::design);
    add("until/assembly", until, Stage::assembly);
    add("until/motion", until, Stage::motion);
    add("until/pattern", until, Stage::pattern);
    add("until/layout", until, Stage::layout);
    add("writing/.pdf", [](benchmark::State& state) {
        writing(state, [](const Compilation& c) {
            Diagnostics diagnostics;
            return write_with<SheetWriter>(".pdf")(*c.layout, {}, diagnostics);
        });
    });
    add("writing/.glb", [](benchmark::State& state) {
        writing(state, [](const Compilation& c) {
            Diagnostics diagnostics;
            const SceneCard scene{&*c.designs[0].assembly, &*c.designs[0].motion, ""};
            return write_with<SceneWriter>(".glb")({&scene, 1}, {}, diagnostics);
        });
    });
    Keeper keeper;
    benchmark::RunSpecifiedBenchmarks(&keeper);
    print_table(keeper);
}
