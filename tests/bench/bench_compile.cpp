// What a compile costs: the solvers against each other, each stage against the number of elements, and one
// whole compile stage by stage. Ends with a table of ratios, all of one run.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "popup/compile.h"
#include "popup/write.h"
#include "support/designs.h"
#include "support/freeform_sheet.h"

namespace popup::test {
namespace {

std::vector<Angle> whole_degrees() {
    std::vector<Angle> angles;
    for (int deg = 0; deg <= 180; ++deg) angles.push_back(Angle::degrees(deg));
    return angles;
}

Source creature() {
    Diagnostics diagnostics;
    auto source = read_source(std::string(POPUP_SOURCE_DIR) + "/samples/creature.xml", diagnostics);
    POPUP_INVARIANT(source.has_value());
    return *source;
}

constexpr int kSample = 26;  // stands for the sample of that many elements

// All stages' values for a row of elements, made once a size.
struct Stages {
    Design design;
    std::optional<CheckedDesign> checked;
    std::optional<Assembly> assembly;
    std::optional<Motion> motion;
    std::optional<Pattern> pattern;
    Pattern cards;  // what the layout repeats
    int copies = 1;
    std::optional<Layout> layout;
    Source source;
};

std::vector<DesignPattern> run_of(const Stages& s) { return {{"row.xml", "row", s.cards}}; }
LayoutOptions run_options(const Stages& s) {
    LayoutOptions options;
    if (s.design.stem == "row") options.sheet = {"", 5000.0, 5000.0};
    options.copies = s.copies;
    return options;
}

MotionOptions unexamined() {
    MotionOptions options;
    options.examine = false;
    return options;
}

const Stages& stages(int elements) {
    static std::map<int, Stages> made;
    const auto [it, fresh] = made.try_emplace(elements);
    Stages& s = it->second;
    if (!fresh) return s;
    Diagnostics diagnostics;
    if (elements == kSample) {
        s.source = creature();
        s.design = *read_design(s.source, {}, diagnostics);
    } else {
        s.design = row(elements);
    }
    s.checked = check(s.design, {}, diagnostics);
    if (!s.checked) fmt::print(stderr, "{}", findings(diagnostics));
    POPUP_INVARIANT(s.checked.has_value());
    s.assembly = assemble(*s.checked, {}, diagnostics);
    s.motion = simulate(*s.assembly, unexamined(), diagnostics);
    s.pattern = make_pattern(*s.assembly, {}, diagnostics);
    // Sheets of a size that exists: a production run of cards of up to 200 elements.
    s.cards =
        elements == kSample
            ? *s.pattern
            : *make_pattern(*assemble(*check(row(std::min(elements, 200)), {}, diagnostics), {}, diagnostics),
                            {}, diagnostics);
    s.copies = elements == kSample ? 1 : std::max(1, elements / 200);
    s.layout = lay_out(run_of(s), run_options(s), diagnostics);
    POPUP_INVARIANT(s.motion && s.layout);
    if (elements != kSample) {
        s.source.name = "row.xml";
        s.source.text = *std::get<DocumentWriter>(find_format(".xml")->write)(*s.checked, {}, diagnostics);
    }
    return s;
}

Compilation built_creature() {
    CompileOptions options;
    options.until = Stage::assembly;
    return compile({creature()}, options, {});
}

void solver_closed_form(benchmark::State& state) {
    const Compilation creature_built = built_creature();
    const Assembly& assembly = *creature_built.designs[0].assembly;
    std::vector<Frame> frames(assembly.plates.size());
    double closure = 0.0;
    for (auto _ : state) {
        for (const Angle at : whole_degrees()) {
            place(assembly, at, frames);
            benchmark::DoNotOptimize(frames.data());
        }
    }
    for (const Angle at : whole_degrees()) {
        place(assembly, at, frames);
        closure = std::max(closure, closure_error(assembly, frames));
    }
    state.counters["closure_mm"] = closure;
}

template <int Repeats>
void solver_iterative(benchmark::State& state) {
    // With the thesis's 5000 repeats close enough is 0.001 mm; with a million it is what the closed form
    // guarantees.
    const double precision = Repeats == 5000 ? 1e-3 : 1e-9;
    const Compilation creature_built = built_creature();
    const Assembly& assembly = *creature_built.designs[0].assembly;
    std::vector<Frame> frames(assembly.plates.size());
    double closure = 0.0;
    for (auto _ : state) {
        IterativePlacer placer(assembly, Repeats, precision);
        for (const Angle at : whole_degrees()) {
            placer.place(at, frames);
            closure = std::max(closure, closure_error(assembly, frames));
        }
    }
    state.counters["closure_mm"] = closure;
}

template <class Run>
void stage(benchmark::State& state, Run run) {
    const Stages& s = stages(static_cast<int>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(run(s));
    state.counters["plates"] = static_cast<double>(s.assembly->plates.size());
}

template <class Writer>
auto write_with(const char* suffix) {
    return std::get<Writer>(find_format(suffix)->write);
}

void whole_compile(benchmark::State& state) {
    const Source source = creature();
    const CompileOptions options;
    for (auto _ : state) {
        const Compilation c = compile({source}, options, {});
        Diagnostics diagnostics;
        const SceneCard scene{&*c.designs[0].assembly, &*c.designs[0].motion, ""};
        benchmark::DoNotOptimize(write_with<SheetWriter>(".svg")(*c.layout, {}, diagnostics));
        benchmark::DoNotOptimize(write_with<SheetWriter>(".pdf")(*c.layout, {}, diagnostics));
        benchmark::DoNotOptimize(write_with<SceneWriter>(".glb")({&scene, 1}, {}, diagnostics));
    }
}

// Pictures of the 26-element sample: a still of 800 × 600 pixels, 60 moving ones of 480 × 360.
void pictures(benchmark::State& state, const char* suffix) {
    CompileOptions options;
    options.until = Stage::motion;
    const Compilation c = compile({creature()}, options, {});
    const SceneCard scene{&*c.designs[0].assembly, &*c.designs[0].motion, ""};
    for (auto _ : state) {
        Diagnostics diagnostics;
        benchmark::DoNotOptimize(write_with<StillWriter>(suffix)({&scene, 1}, {}, diagnostics));
    }
}

constexpr const char* kPaged = "sheets and page, of so many threads";
// The 26-element sample laid out, and its page if there are threads to make it: its model, its sheets and a
// still.
void page(benchmark::State& state) {
    const Source source = creature();
    const bool paged = state.range(0) > 0;
    CompileOptions options;
    options.until = Stage::pattern;
    options.output.threads = paged ? static_cast<int>(state.range(0)) : 1;
    Diagnostics diagnostics;
    const auto plan = plan_outputs({.outputs = {"creature.html"}}, diagnostics);
    POPUP_INVARIANT(plan.has_value());
    for (auto _ : state) {
        Compilation run = compile({source}, options, {});
        const BegunFiles begun = begin_files(*plan, options.output, run);
        lay_out_run(run, options);
        if (paged) benchmark::DoNotOptimize(make_files(*plan, options.output, run, begun));
    }
}

const std::vector<int> kSheets{250, 500, 1000};

// A sheet of so many drawn features, read, examined and written to SVG and GLB.
void drawn_sheet(benchmark::State& state) {
    const Source source{"sheet.xml", freeform_sheet(static_cast<int>(state.range(0)))};
    CompileOptions options;
    options.layout.sheet = {"", 40000.0, 40000.0};
    for (auto _ : state) {
        const Compilation c = compile({source}, options, {});
        // That a sheet of some metres is an unlikely page is told.
        POPUP_INVARIANT(c.layout && !c.designs[0].diagnostics.has_errors());
        Diagnostics diagnostics;
        const SceneCard scene{&*c.designs[0].assembly, &*c.designs[0].motion, ""};
        benchmark::DoNotOptimize(write_with<SheetWriter>(".svg")(*c.layout, {}, diagnostics));
        benchmark::DoNotOptimize(write_with<SceneWriter>(".glb")({&scene, 1}, {}, diagnostics));
    }
}

// Keeps every result, besides printing it.
class Keeper : public benchmark::ConsoleReporter {
 public:
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs) {
            if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
            cpu_ns[run.benchmark_name()] =
                run.GetAdjustedCPUTime() * 1e9 / benchmark::GetTimeUnitMultiplier(run.time_unit);
            wall_ms[run.benchmark_name()] =
                run.GetAdjustedRealTime() * 1e3 / benchmark::GetTimeUnitMultiplier(run.time_unit);
            for (const auto& [name, counter] : run.counters)
                counters[run.benchmark_name() + "/" + name] = counter;
        }
        ConsoleReporter::ReportRuns(runs);
    }
    std::map<std::string, double> cpu_ns, wall_ms, counters;
};

const std::vector<int> kSizes{10, 100, 1000, 10000, 100000};
std::vector<std::string> stage_names;

template <class Run>
void add_stage(const std::string& name, Run run, int most = kSizes.back()) {
    stage_names.push_back(name);
    auto* one =
        benchmark::RegisterBenchmark(name.c_str(), [run](benchmark::State& state) { stage(state, run); });
    one->Arg(kSample)->Unit(benchmark::kMicrosecond);
    for (const int size : kSizes) {
        if (size <= most) one->Arg(size);
    }
}

void print_tables(const Keeper& keeper) {
    const auto ns = [&](const std::string& name) {
        return keeper.cpu_ns.contains(name) ? keeper.cpu_ns.at(name) : NAN;
    };
    const auto counter = [&](const std::string& name) {
        return keeper.counters.contains(name) ? keeper.counters.at(name) : NAN;
    };
    fmt::print(
        "\n26-element sample, 181 angles: closed form {:.0f} times faster than placement by distances, and "
        "{:.1e} times "
        "more accurate ({:.1e} mm against {:.1e} mm)\n",
        ns("solver/iterative") / ns("solver/closed form"),
        counter("solver/iterative/closure_mm") / counter("solver/closed form/closure_mm"),
        counter("solver/closed form/closure_mm"), counter("solver/iterative/closure_mm"));
    fmt::print(
        "asked for 1e-9 mm, placement by distances takes {:.0f} times as long as the closed form and reaches "
        "{:.1e} mm\n",
        ns("solver/iterative, exact") / ns("solver/closed form"),
        counter("solver/iterative, exact/closure_mm"));
    fmt::print("26-element sample to SVG, PDF and GLB: {:.2f} ms of CPU, of which",
               ns("whole compile") / 1e6);
    std::vector<std::pair<double, std::string>> shares;
    for (const std::string& name : stage_names)
        shares.emplace_back(ns(fmt::format("{}/{}", name, kSample)), name);
    std::sort(shares.rbegin(), shares.rend());
    for (const auto& [cost, name] : shares)
        fmt::print(" {} {:.0f} %", name, 100.0 * cost / ns("whole compile"));
    const auto paged_ms = [&](int threads) {
        const auto found = keeper.wall_ms.find(fmt::format("{}/{}/real_time", kPaged, threads));
        return found != keeper.wall_ms.end() ? found->second : NAN;
    };
    fmt::print(
        "\nits sheets {:.2f} ms; its page beside them {:.2f} ms more with one thread, {:.2f} ms with two\n",
        paged_ms(0), paged_ms(1) - paged_ms(0), paged_ms(2) - paged_ms(0));
    fmt::print("\n| stage, CPU per element relative to 1000 elements |");
    for (const int size : kSizes) fmt::print(" {} |", size);
    fmt::print("\n|---|");
    for (std::size_t i = 0; i < kSizes.size(); ++i) fmt::print("---|");
    for (const std::string& name : stage_names) {
        fmt::print("\n| {} |", name);
        const double base = ns(fmt::format("{}/1000", name)) / 1000;
        for (const int size : kSizes) {
            const double cost = ns(fmt::format("{}/{}", name, size)) / size / base;
            fmt::print("{}", std::isnan(cost) ? " |" : fmt::format(" {:.2f} |", cost));
        }
    }
    fmt::print(
        "\n\n| freeform features on a sheet, to SVG and GLB | ms | a feature, relative to 250 "
        "|\n|---|---|---|\n");
    for (const int size : kSheets) {
        const auto of = [&](int n) { return ns(fmt::format("drawn sheet/{}", n)); };
        fmt::print("| {} | {:.0f} | {:.2f} |\n", size, of(size) / 1e6, of(size) / size / (of(250) / 250));
    }
}

}  // namespace
}  // namespace popup::test

int main(int argc, char** argv) {
    using namespace popup;
    using namespace popup::test;
    benchmark::Initialize(&argc, argv);
    benchmark::RegisterBenchmark("solver/closed form", solver_closed_form)->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark("solver/iterative", solver_iterative<5000>)->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark("solver/iterative, exact", solver_iterative<1000000>)
        ->Unit(benchmark::kMicrosecond);
    benchmark::RegisterBenchmark("whole compile", whole_compile)->Unit(benchmark::kMicrosecond);
    for (const char* suffix : {".view.png", ".webp", ".gif"})
        benchmark::RegisterBenchmark((std::string("picture/") + suffix).c_str(), pictures, suffix)
            ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(kPaged, page)
        ->Arg(0)
        ->Arg(1)
        ->Arg(2)
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
    auto* sheets = benchmark::RegisterBenchmark("drawn sheet", drawn_sheet)->Unit(benchmark::kMillisecond);
    for (const int size : kSheets) sheets->Arg(size);
    static Diagnostics ignored;
    add_stage("read", [](const Stages& s) { return read_design(s.source, {}, ignored); });
    add_stage("check", [](const Stages& s) { return check(s.design, {}, ignored); });
    add_stage("assemble", [](const Stages& s) { return assemble(*s.checked, {}, ignored); });
    add_stage("simulate, 37 angles",
              [](const Stages& s) { return simulate(*s.assembly, unexamined(), ignored); });
    add_stage("simulate: what is forced", [](const Stages& s) { return free_plates(*s.assembly); });
    // bench_collide says more of this one.
    add_stage(
        "examine", [](const Stages& s) { return examine(*s.assembly, {}); }, 10000);
    add_stage("pattern", [](const Stages& s) { return make_pattern(*s.assembly, {}, ignored); });
    add_stage("layout", [](const Stages& s) { return lay_out(run_of(s), run_options(s), ignored); });
    add_stage("SVG", [](const Stages& s) { return write_with<SheetWriter>(".svg")(*s.layout, {}, ignored); });
    add_stage("PDF", [](const Stages& s) { return write_with<SheetWriter>(".pdf")(*s.layout, {}, ignored); });
    add_stage("GLB", [](const Stages& s) {
        const SceneCard scene{&*s.assembly, &*s.motion, ""};
        return write_with<SceneWriter>(".glb")({&scene, 1}, {}, ignored);
    });
    Keeper keeper;
    benchmark::RunSpecifiedBenchmarks(&keeper);
    print_tables(keeper);
}
