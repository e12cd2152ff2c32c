// How well nesting does: density of strips beside what others published, sheets for jobs whose optimum is
// known, jobs of a workshop, and a large job with its time and memory. Every layout goes through the exact
// check; the exit status is 1 when one has a fault or a job is refused.
//
//   bench_nesting [--seconds S[,S...]] [--seeds N] [--threads N] [--large N] [--long] [WORD...]
//
// --seconds  how long to look at an instance, one run for each (default 1.5; --long: 10,60)
// --seeds    runs for each of those, with seeds 0 to N-1 (default 1); tables give the mean
// --threads  default 2
// --large    pieces of the large job (default 1000; 0: none)
// --long     the runs that figures are quoted from; the large job with normal effort too
// WORD       only instances whose name contains one: strip/albano, bins, large
//
// Seconds in brackets are those that a run took. Where there are no instances of others (see nest_data()) it
// says so, does the large job, and ends well.
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <string_view>

#include "popup/diagnostics.h"
#include "support/nest_check.h"
#include "support/nest_figures.h"
#include "support/nest_instances.h"

namespace popup::test {
namespace {

struct Options {
    std::vector<double> seconds{1.5};
    int seeds = 1;
    int threads = 2;
    int large = 1000;
    bool all = false;
    std::vector<std::string> words;

    [[nodiscard]] bool wants(const std::string& name) const {
        return words.empty() || std::any_of(words.begin(), words.end(), [&](const std::string& word) {
                   return name.find(word) != std::string::npos;
               });
    }
};

int faulty = 0;  // layouts with faults, and refusals

template <class... Values>
void say(fmt::format_string<Values...> words, Values&&... values) {
    fmt::print(words, std::forward<Values>(values)...);
    std::fflush(stdout);
}

// One layout, checked.
struct Outcome {
    bool placed = false;
    int sheets = 0;
    double last_length = 0.0;  // mm
    double seconds = 0.0;
    double megabytes = 0.0;  // peak of this process, before the check
};

Outcome run(const NestInstance& instance, const NestEffort& effort) {
    Outcome outcome;
    const auto start = std::chrono::steady_clock::now();
    const NestResult result = nest(instance.job, effort);
    outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    rusage usage{};
    POPUP_INVARIANT(getrusage(RUSAGE_SELF, &usage) == 0);
    outcome.megabytes = static_cast<double>(usage.ru_maxrss) / 1024.0;
    if (!result.plan) {
        ++faulty;
        const auto reason = result.refusal ? static_cast<int>(result.refusal->reason) : -1;
        const std::size_t items = result.refusal ? result.refusal->items.size() : 0;
        say("\n{}: refused, reason {}, {} items\n", instance.name, reason, items);
        return outcome;
    }
    outcome.placed = true;
    outcome.sheets = static_cast<int>(result.plan->sheets.size());
    outcome.last_length = result.plan->used.empty() ? 0.0 : result.plan->used.back().x;
    const std::vector<std::string> faults = nest_faults(instance.job, *result.plan);
    if (faults.empty()) return outcome;
    ++faulty;
    say("\n{}, seed {}: {} faults\n", instance.name, effort.seed, faults.size());
    for (std::size_t i = 0; i < std::min<std::size_t>(faults.size(), 10); ++i) say("  {}\n", faults[i]);
    return outcome;
}

// Means over the seeds.
struct Mean {
    double sheets = 0.0;
    double last_length = 0.0;
    double density = 0.0;  // %, of a strip
    double seconds = 0.0;
};

Mean mean_of(const NestInstance& instance, NestEffort effort, int seeds) {
    Mean mean;
    int runs = 0;
    for (int seed = 0; seed < seeds; ++seed) {
        effort.seed = static_cast<std::uint64_t>(seed);
        const Outcome outcome = run(instance, effort);
        if (!outcome.placed) continue;
        ++runs;
        mean.sheets += outcome.sheets;
        mean.last_length += outcome.last_length;
        mean.density += 100.0 * instance.area / (instance.job.stock.front().height * outcome.last_length);
        mean.seconds += outcome.seconds;
    }
    if (runs == 0) return {};
    mean.sheets /= runs;
    mean.last_length /= runs;
    mean.density /= runs;
    mean.seconds /= runs;
    return mean;
}

NestEffort fast(const Options& options) {
    NestEffort effort;
    effort.work = kFastNesting;
    effort.threads = options.threads;
    return effort;
}

NestEffort timed(const Options& options, double seconds) {
    NestEffort effort;
    effort.work = kBestNesting;
    effort.threads = options.threads;
    effort.seconds = seconds;
    return effort;
}

// Means over the instances that have both figures, ours and another's.
struct Comparison {
    double ours = 0.0;
    double theirs = 0.0;
    int count = 0;

    void add(double our, std::optional<double> their) {
        if (!their) return;
        ours += our;
        theirs += *their;
        ++count;
    }
};

std::string cell(std::optional<double> figure) { return figure ? fmt::format("{:.2f}", *figure) : ""; }

struct Rival {
    const char* name;
    std::optional<double> StripFigures::*figure;
};
constexpr std::array<Rival, 8> kRivals{{{"sparrow 1200 s", &StripFigures::sparrow},
                                        {"best known", &StripFigures::best},
                                        {"ROMA", &StripFigures::roma},
                                        {"GCS", &StripFigures::gcs},
                                        {"sparrow, 1 worker, 60 s", &StripFigures::sparrow_60},
                                        {"sparrow, 1 worker, 10 s", &StripFigures::sparrow_10},
                                        {"SVGnest 60 s", &StripFigures::svgnest},
                                        {"libnest2d 30 s", &StripFigures::libnest2d}}};

void strips(const std::vector<NestInstance>& instances, const Options& options) {
    say("\nStrips: density in %\n\n| instance (pieces) | fast (s) |");
    for (const double seconds : options.seconds) say(" {:g} s (s) |", seconds);
    for (const Rival& rival : kRivals) say(" {} |", rival.name);
    say(" less sparrow 60 s |\n|---|---|");
    for (std::size_t i = 0; i < options.seconds.size() + kRivals.size() + 1; ++i) say("---|");
    say("\n");
    // Of the fast effort, then of each time; by rival.
    std::vector<std::array<Comparison, kRivals.size()>> sums(options.seconds.size() + 1);
    for (const NestInstance& instance : instances) {
        if (instance.form != NestInstance::Form::strip) continue;
        const StripFigures* figures = strip_figures(instance.name);
        const auto count = [&](std::size_t column, double density) {
            for (std::size_t k = 0; figures && k < kRivals.size(); ++k) {
                sums[column][k].add(density, figures->*kRivals[k].figure);
            }
        };
        say("| {} ({}) |", instance.name.substr(6), instance.job.items.size());
        const Mean quick = mean_of(instance, fast(options), options.seeds);
        count(0, quick.density);
        say(" {:.2f} ({:.2f}) |", quick.density, quick.seconds);
        double last = 0.0;
        for (std::size_t i = 0; i < options.seconds.size(); ++i) {
            const Mean mean = mean_of(instance, timed(options, options.seconds[i]), options.seeds);
            last = mean.density;
            count(i + 1, last);
            say(" {:.2f} ({:.2f}) |", last, mean.seconds);
        }
        for (const Rival& rival : kRivals) say(" {} |", figures ? cell(figures->*rival.figure) : "");
        const bool known = figures && figures->sparrow_60;
        say(" {} |\n", known ? fmt::format("{:+.2f}", last - *figures->sparrow_60) : "");
    }
    say("\nMeans over the instances that both have\n\n| effort | rival | instances | ours | theirs | "
        "difference "
        "|\n|---|---|---|---|---|---|\n");
    for (std::size_t column = 0; column < sums.size(); ++column) {
        for (std::size_t k = 0; k < kRivals.size(); ++k) {
            const Comparison& sum = sums[column][k];
            if (sum.count == 0) continue;
            say("| {} | {} | {} | {:.2f} | {:.2f} | {:+.2f} |\n",
                column == 0 ? "fast" : fmt::format("{:g} s", options.seconds[column - 1]), kRivals[k].name,
                sum.count, sum.ours / sum.count, sum.theirs / sum.count, (sum.ours - sum.theirs) / sum.count);
        }
    }
}

void bins(const std::vector<NestInstance>& instances, const Options& options) {
    say("\nBins of known optimum: sheets\n\n| instance (pieces) | optimum | fast (s) |");
    for (const double seconds : options.seconds) say(" {:g} s (s) |", seconds);
    say(" libnest2d 30 s |\n|---|---|---|---|");
    for (std::size_t i = 0; i < options.seconds.size(); ++i) say("---|");
    say("\n");
    std::vector<Mean> sums(options.seconds.size() + 1);
    int optimum = 0;
    int theirs = 0;
    for (const NestInstance& instance : instances) {
        if (instance.form != NestInstance::Form::bins) continue;
        say("| {} ({}) | {} |", instance.name.substr(5), instance.job.items.size(), instance.optimum);
        optimum += instance.optimum;
        for (std::size_t i = 0; i < sums.size(); ++i) {
            const Mean mean = mean_of(
                instance, i == 0 ? fast(options) : timed(options, options.seconds[i - 1]), options.seeds);
            sums[i].sheets += mean.sheets;
            sums[i].seconds += mean.seconds;
            say(" {:g} ({:.2f}) |", mean.sheets, mean.seconds);
        }
        const auto sheets = libnest2d_sheets(instance.name);
        theirs += sheets.value_or(0);
        say(" {} |\n", sheets ? std::to_string(*sheets) : "");
    }
    say("| all | {} |", optimum);
    for (const Mean& sum : sums) say(" {:g} ({:.2f}) |", sum.sheets, sum.seconds);
    say(" {} |\n", theirs);
}

void cutting(const std::vector<NestInstance>& instances, const Options& options) {
    say("\nJobs: sheets and length of the last one in the file's unit\n\n| job (pieces) | sheet | least by "
        "area | "
        "fast (s) |");
    for (const double seconds : options.seconds) say(" {:g} s (s) |", seconds);
    say("\n|---|---|---|---|");
    for (std::size_t i = 0; i < options.seconds.size(); ++i) say("---|");
    say("\n");
    for (const NestInstance& instance : instances) {
        if (instance.form != NestInstance::Form::cutting) continue;
        const NestStock& stock = instance.job.stock.front();
        say("| {} ({}) | {:g} × {:g} | {:.2f} |", instance.name.substr(5), instance.job.items.size(),
            stock.width, stock.height, instance.area / (stock.width * stock.height));
        const Mean quick = mean_of(instance, fast(options), options.seeds);
        say(" {:g}, {:.2f} ({:.2f}) |", quick.sheets, quick.last_length, quick.seconds);
        for (const double seconds : options.seconds) {
            const Mean mean = mean_of(instance, timed(options, seconds), options.seeds);
            say(" {:g}, {:.2f} ({:.2f}) |", mean.sheets, mean.last_length, mean.seconds);
        }
        say("\n");
    }
}

// First of all, so that the peak of memory is its own.
void large(const Options& options) {
    const NestInstance instance = large_nest_instance(options.large, 1);
    const NestStock& stock = instance.job.stock.front();
    say("\nA large job: {} pieces of {} kinds, A3 sheets, {:.2f} sheets by area\n\n", options.large,
        instance.job.kinds.size(), instance.area / (stock.width * stock.height));
    say("| effort | sheets | length of the last one | utilisation % | s | peak MB | check s |\n"
        "|---|---|---|---|---|---|---|\n");
    const auto line = [&](const char* name, double work) {
        NestEffort effort = fast(options);
        effort.work = work;
        const auto start = std::chrono::steady_clock::now();
        const Outcome outcome = run(instance, effort);
        const std::chrono::duration<double> all = std::chrono::steady_clock::now() - start;
        const double taken = ((outcome.sheets - 1) * stock.width + outcome.last_length) * stock.height;
        say("| {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.0f} | {:.2f} |\n", name, outcome.sheets,
            outcome.last_length, 100.0 * instance.area / taken, outcome.seconds, outcome.megabytes,
            all.count() - outcome.seconds);
    };
    line("fast", kFastNesting);
    if (options.all) line("normal", kNormalNesting);
}

int report(const Options& options) {
    if (!nest_check_available()) say("{}\n", kNestCheckMissing);
    if (options.large > 0 && options.wants("large")) large(options);
    const auto data = nest_data();
    if (!data) {
        say("{}\n", kNestDataMissing);
    } else {
        const auto instances = nest_instances(*data, options.words);
        const auto have = [&](NestInstance::Form form) {
            return std::any_of(instances.begin(), instances.end(),
                               [form](const NestInstance& instance) { return instance.form == form; });
        };
        if (have(NestInstance::Form::strip)) strips(instances, options);
        if (have(NestInstance::Form::bins)) bins(instances, options);
        if (have(NestInstance::Form::cutting)) cutting(instances, options);
    }
    say("\n{} layouts with faults or jobs refused\n", faulty);
    return faulty == 0 ? 0 : 1;
}

template <class Number>
bool read_number(std::string_view text, Number& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size();
}

bool read_list(std::string_view text, std::vector<double>& list) {
    list.clear();
    while (true) {
        const std::size_t comma = text.find(',');
        if (!read_number(text.substr(0, comma), list.emplace_back())) return false;
        if (comma == std::string_view::npos) return true;
        text.remove_prefix(comma + 1);
    }
}

bool read_options(int argc, char** argv, Options& options) {
    bool timed = false;
    for (int i = 1; i < argc; ++i) {
        const std::string_view word = argv[i];
        const std::string_view value = i + 1 < argc ? argv[i + 1] : "";
        bool fine = true;
        if (word == "--long") {
            options.all = true;
            continue;
        }
        if (word == "--seconds") {
            fine = timed = read_list(value, options.seconds);
        } else if (word == "--seeds") {
            fine = read_number(value, options.seeds);
        } else if (word == "--threads") {
            fine = read_number(value, options.threads);
        } else if (word == "--large") {
            fine = read_number(value, options.large);
        } else if (word.starts_with("-")) {
            return false;
        } else {
            options.words.emplace_back(word);
            continue;
        }
        if (!fine) return false;
        ++i;
    }
    if (options.all && !timed) options.seconds = {10.0, 60.0};
    return options.seeds >= 1 && options.threads >= 1 && options.large >= 0;
}

}  // namespace
}  // namespace popup::test

int main(int argc, char** argv) {
    popup::test::Options options;
    if (!popup::test::read_options(argc, argv, options)) {
        fmt::print(stderr,
                   "usage: bench_nesting [--seconds S[,S...]] [--seeds N] [--threads N] [--large N] [--long] "
                   "[WORD...]\n");
        return 2;
    }
    return popup::test::report(options);
}
