// What libnest2d makes of the nesting instances: fewest sheets, highest density, every layout checked.
//
//   compare_libnest2d [--seconds S] [--verbose] [WORD...]
//
// S seconds an instance (0.5 unless said otherwise: enough to see that it works; the figures that we compare
// with are those of 30). WORD picks the instances whose name contains it. Where there are no instances it
// says so and ends well. Faults are counted, not judged: it rounds places to a grid of its own, so that
// pieces overlap by a step or two of that.
#include <fmt/format.h>

#include <cstdlib>
#include <cstring>

#include "support/nest_check.h"
#include "support/nest_figures.h"
#include "support/nest_libnest2d.h"

namespace popup::test {
namespace {

struct Options {
    double seconds = 0.5;
    bool verbose = false;
    std::vector<std::string> words;
};

std::string score(const NestInstance& instance, const std::optional<ForeignLayout>& layout) {
    if (!layout) return "none";
    const NestPlan& plan = layout->plan;
    if (instance.form == NestInstance::Form::bins) return std::to_string(plan.sheets.size());
    if (plan.sheets.size() > 1) return fmt::format("{} sheets", plan.sheets.size());
    return fmt::format("{:.2f}", 100.0 * instance.area / (instance.job.stock[0].height * plan.used[0].x));
}

void compare(const NestInstance& instance, const Options& options) {
    const ForeignBest best = libnest2d_best(instance, options.seconds, [&](const std::string& words) {
        if (options.verbose) fmt::print(stderr, "  {}: {}\n", instance.name, words);
    });
    std::vector<std::string> faults;
    if (best.shuffled) faults = nest_faults(instance.job, best.shuffled->plan);
    fmt::print("| {} | {} | {} | {} | {} | {:.2f} | {} | {} |\n", instance.name,
               score(instance, best.settled), score(instance, best.shuffled), best.settings_tried,
               best.orders_tried, best.shuffled ? best.shuffled->seconds : 0.0,
               best.shuffled ? best.shuffled->settings : "none", faults.size());
    std::fflush(stdout);
    for (std::size_t i = 0; i < faults.size() && i < 3; ++i) fmt::print("  {}\n", faults[i]);
}

int run(const Options& options) {
    const auto data = nest_data();
    if (!data) {
        fmt::print("{}\n", kNestDataMissing);
        return 0;
    }
    if (!nest_check_available()) fmt::print("{}\n", kNestCheckMissing);
    fmt::print("\nlibnest2d, {:g} s an instance, hulls; density in % or sheets\n\n", options.seconds);
    fmt::print(
        "| instance | its settings | and random orders | settings tried | orders tried | s for the best | "
        "best settings | faults |\n|---|---|---|---|---|---|---|---|\n");
    for (const NestInstance& instance : nest_instances(*data, options.words)) {
        if (instance.form != NestInstance::Form::cutting) compare(instance, options);
    }
    return 0;
}

}  // namespace
}  // namespace popup::test

int main(int argc, char** argv) {
    popup::test::Options options;
    for (int i = 1; i < argc; ++i) {
        if (std::strcmp(argv[i], "--seconds") == 0 && i + 1 < argc) {
            options.seconds = std::atof(argv[++i]);
        } else if (std::strcmp(argv[i], "--verbose") == 0) {
            options.verbose = true;
        } else if (argv[i][0] == '-') {
            fmt::print(stderr, "usage: compare_libnest2d [--seconds S] [--verbose] [WORD...]\n");
            return 2;
        } else {
            options.words.emplace_back(argv[i]);
        }
    }
    return popup::test::run(options);
}
