// What running a FlatLang program costs: for each evaluation step and for each line that is drawn, at sizes
// from 10^3 to 10^6, and the ratio to the smallest, which is near 1 where cost is linear.
//
//   bench_flatlang [LARGEST]
//
// LARGEST (1 000 000 unless said otherwise) bounds the sizes. Figures are the best of a few runs; nothing is
// asserted.
#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "input/flatlang/pieces/pieces.h"
#include "input/flatlang/run/interpreter.h"
#include "popup/files.h"

namespace popup::flatlang {
namespace {

namespace fs = std::filesystem;

double cpu_seconds() {
    timespec time{};
    ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Seconds of CPU of a run, whatever else the machine does: the best of a few, of long ones of fewer, and of
// short ones of many in a row.
template <class Run>
double seconds(Run run) {
    double best = HUGE_VAL;
    double all = 0.0;
    int in_a_row = 1;
    for (int i = 0; i < 7 && (i == 0 || all < 1.0); ++i) {
        const double begun = cpu_seconds();
        for (int j = 0; j < in_a_row; ++j) run();
        const double took = cpu_seconds() - begun;
        constexpr double kLongEnough = 0.02;
        if (took < kLongEnough && in_a_row < 1000) {
            in_a_row *= 4;
            --i;
            continue;
        }
        best = std::min(best, took / in_a_row);
        all += took;
    }
    return best;
}

struct Outcome {
    ProgramRun run;
    bool good = false;
};

Outcome outcome(const Source& source, const ReadOptions& options) {
    Diagnostics diagnostics(source.name);
    Outcome made;
    made.run = run_program(source, options, diagnostics);
    made.good = made.run.status == RunStatus::ok && !diagnostics.has_errors();
    return made;
}

ReadOptions without_limits() {
    ReadOptions options;
    options.program.limits = {.steps = std::uint64_t{1} << 40,
                              .depth = 100'000,
                              .values = std::uint64_t{1} << 40,
                              .text = std::uint64_t{1} << 30,
                              .trail = std::uint64_t{1} << 40};
    return options;
}

// A program for so many rounds.
struct Kind {
    const char* name;
    std::string (*program)(int rounds);
};

const std::vector<Kind>& kinds() {
    static const std::vector<Kind> all{
        {"arithmetic",
         [](int n) {
             return fmt::format("a = 0 i = 0 while (i < {}) i = i + 1 a = (a * 3 + i) % 1000 done", n / 14);
         }},
        {"calls",
         [](int n) {
             return fmt::format(
                 "define f(a, b) a + b done safe define g(x) f(x, 1) done r = 0 repeat ({}) r = g(r) done",
                 n / 13);
         }},
        {"recursion",
         [](int n) {
             return fmt::format("define f(n) if (n > 0) f(n - 1) + 1 else 0 done done repeat ({}) f(90) done",
                                n / 1000);
         }},
        {"lists",
         [](int n) {
             return fmt::format(
                 "l = [] repeat ({0}) l = cons(1, l) done s = 0 for each (e : l) s = s + e done m = rev(l)",
                 n / 16);
         }},
        {"texts",
         [](int n) { return fmt::format("repeat ({}) s = \"n\" + 1.5 t = eq(s, \"n1.5\") done", n / 14); }},
        {"objects",
         [](int n) {
             return fmt::format(
                 "define grow(by) size = size + by done o = object(\"o\") o.size = 1 o.grow = grow "
                 "repeat ({}) o.grow(1) done",
                 n / 10);
         }},
        {"eval", [](int n) { return fmt::format("x = 1 repeat ({}) x = eval(\"x + 1\") done", n / 85); }},
        {"turtle", [](int n) { return fmt::format("repeat ({}) forward(1) left(7) done", n / 11); }},
        {"marks",
         [](int n) {
             return fmt::format("mark(\"m\") repeat ({}) forward(1) backto(\"m\") left(1) done", n / 16);
         }},
        {"places",
         [](int n) { return fmt::format("repeat ({}) forward(1) p = pos() left(7) done", n / 15); }},
    };
    return all;
}

// Programs that draw about so many lines.
const std::vector<Kind>& drawings() {
    static const std::vector<Kind> all{
        {"one line that goes on",
         [](int n) { return fmt::format("i = 0 repeat ({}) i = i + 0.0001 forward(i) left(7) done", n); }},
        {"squares side by side",
         [](int n) {
             return fmt::format(
                 "repeat ({}) repeat (100) repeat (4) forward(1) left(90) done up() forward(1.5) down() "
                 "done up() backward(150) right(90) forward(1.5) left(90) down() done",
                 n / 400);
         }},
        {"a branch a line",
         [](int n) {
             return fmt::format(
                 "mark(\"m\") repeat ({}) forward(1) backto(\"m\") "
                 "left(0.001) done",
                 n);
         }},
        {"parts",
         [](int n) {
             return fmt::format(
                 "repeat ({}) repeat (200) part(\"p\") repeat (4) forward(1) left(90) done up() forward(1.5) "
                 "down() done "
                 "up() backward(300) right(90) forward(1.5) left(90) down() done",
                 n / 800);
         }},
    };
    return all;
}

bool report_steps(int largest) {
    bool good = true;
    fmt::print("evaluation\n  {:<24}{:>10}{:>12}{:>14}{:>10}\n", "", "steps", "ns a step", "steps/s",
               "ratio");
    for (const Kind& kind : kinds()) {
        double smallest = 0.0;
        for (int size = 1000; size <= largest; size *= 10) {
            const Source source{"bench.fl", kind.program(size)};
            const ReadOptions options = without_limits();
            const Outcome made = outcome(source, options);
            good = good && made.good;
            // Without what a run of nothing takes.
            const double nothing = seconds([&] { outcome({"bench.fl", ""}, options); });
            const double took = std::max(1e-9, seconds([&] { outcome(source, options); }) - nothing);
            const double each = took / static_cast<double>(std::max<std::uint64_t>(1, made.run.steps));
            if (smallest == 0.0) smallest = each;
            fmt::print("  {:<24}{:>10}{:>12.1f}{:>14.3g}{:>10.2f}\n", kind.name, made.run.steps, 1e9 * each,
                       1.0 / each, each / smallest);
        }
    }
    return good;
}

// Lines, polygons and parts: running the program with its trail, and making pieces of that.
bool report_lines(int largest) {
    bool good = true;
    fmt::print("drawing\n  {:<24}{:>10}{:>12}{:>14}{:>10}{:>14}{:>10}\n", "", "lines", "polygons",
               "µs a line", "ratio", "µs in pieces", "ratio");
    for (const Kind& kind : drawings()) {
        double smallest = 0.0, smallest_pieces = 0.0;
        for (int size = 1000; size <= largest; size *= 10) {
            const Source source{"bench.fl", kind.program(size)};
            const ReadOptions options = without_limits();
            const Outcome made = outcome(source, options);
            good = good && made.good;
            const auto lines = static_cast<double>(std::max<std::size_t>(1, made.run.trail.segments.size()));
            const double each = seconds([&] { outcome(source, options); }) / lines;
            bool pieces = false;
            const double each_pieces = seconds([&] {
                                           Diagnostics diagnostics("bench.fl");
                                           pieces = make_parts(made.run.trail, diagnostics).has_value();
                                       }) /
                                       lines;
            if (smallest == 0.0) {
                smallest = each;
                smallest_pieces = each_pieces;
            }
            fmt::print("  {:<24}{:>10}{:>12}{:>14.3f}{:>10.2f}{:>14.3f}{:>10.2f}{}\n", kind.name,
                       made.run.trail.segments.size(), made.run.trail.polygons.size(), 1e6 * each,
                       each / smallest, 1e6 * each_pieces, each_pieces / smallest_pieces,
                       pieces ? "" : "  refused");
        }
    }
    return good;
}

// Of other people's programs the one that takes the most steps; and all of them.
void report_shared() {
    const fs::path programs = fs::path(POPUP_SOURCE_DIR) / "../shared/data/flatlang/programs";
    if (!fs::exists(programs)) {
        fmt::print("shared programs: they are not here\n");
        return;
    }
    struct Row {
        std::string name;
        std::uint64_t steps;
        std::size_t lines;
        double seconds;
    };
    std::vector<Row> rows;
    ReadOptions options;
    options.program.as_2008 = true;
    options.program.folders = {programs, programs / "distro/flatcad-examples", programs / "fl",
                               programs / "distro"};
    for (const auto& entry : fs::recursive_directory_iterator(programs)) {
        if (entry.path().extension() != ".fl") continue;
        Diagnostics diagnostics;
        const auto source = read_source(entry.path().string(), diagnostics);
        if (!source) continue;
        const Outcome made = outcome(*source, options);
        if (made.run.status == RunStatus::timeout) continue;  // it never ends
        const double took = seconds([&] { outcome(*source, options); });
        rows.push_back({fs::relative(entry.path(), programs).string(), made.run.steps,
                        made.run.trail.segments.size(), took});
    }
    std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) { return a.seconds > b.seconds; });
    double all = 0.0;
    for (const Row& row : rows) all += row.seconds;
    fmt::print("shared programs: {} that end, {:.1f} ms together; the longest\n", rows.size(), 1e3 * all);
    for (std::size_t i = 0; i < rows.size() && i < 3; ++i) {
        fmt::print("  {:<40}{:>10} steps{:>10} lines{:>10.2f} ms\n", rows[i].name, rows[i].steps,
                   rows[i].lines, 1e3 * rows[i].seconds);
    }
}

}  // namespace
}  // namespace popup::flatlang

int main(int argc, char** argv) {
    std::setvbuf(stdout, nullptr, _IOLBF, 0);
    const int largest = argc > 1 ? std::atoi(argv[1]) : 1'000'000;
    if (largest < 1000) {
        fmt::print(stderr, "bench_flatlang [LARGEST]\n");
        return 2;
    }
    const bool steps = popup::flatlang::report_steps(largest);
    const bool lines = popup::flatlang::report_lines(largest);
    popup::flatlang::report_shared();
    if (!steps || !lines) fmt::print(stderr, "bench_flatlang: some program failed\n");
    return steps && lines ? 0 : 1;
}
