// What a batch costs: designs a second and core, the share of it that is fixed, how it scales over the cores,
// and how much memory it takes for however many designs.
//
//   bench_batch [DESIGNS]
//
// DESIGNS (10 000 unless said otherwise) is the number of small cards of the long run. Figures are of one
// run, as ratios where that is possible; nothing is asserted.
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "support/run_program.h"

namespace popup::test {
namespace {

namespace fs = std::filesystem;

struct Cost {
    double seconds = 0.0;  // by the clock
    double cpu = 0.0;      // of all processes
    double peak_mb = 0.0;  // of the largest
    bool good = false;
};

Cost measured(const fs::path& directory, std::vector<std::string> words) {
    words.insert(words.begin(), kPopupc);
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const auto begun = std::chrono::steady_clock::now();
    const pid_t child = ::fork();
    if (child == 0) {
        if (::chdir(directory.c_str()) != 0) ::_exit(126);
        ::execv(argv[0], argv.data());
        ::_exit(127);
    }
    int status = 0;
    struct rusage used {};
    ::wait4(child, &status, 0, &used);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
    return {took.count(), seconds(used.ru_utime) + seconds(used.ru_stime),
            static_cast<double>(used.ru_maxrss) / 1024.0, WIFEXITED(status) && WEXITSTATUS(status) == 0};
}

// A card with one box, no two alike.
std::string card(int number) {
    const int width = 15 + number % 20;
    const int height = 10 + number / 20 % 50;
    const int length = 140 + number / 1000;
    return fmt::format(
        "<popup version=\"2.0\" units=\"mm\"><mainpage width=\"200\" height=\"{2}\"/><structurelist>"
        "<structure type=\"step\" id=\"box\"><outerpoints><point x=\"-{0}\" y=\"{1}\"/><point x=\"-{0}\" "
        "y=\"-{1}\"/><point x=\"{0}\" y=\"{1}\"/><point x=\"{0}\" "
        "y=\"-{1}\"/></outerpoints><parentfold><begin "
        "x=\"0\" y=\"-{3}\"/><end x=\"0\" y=\"{3}\"/></parentfold></structure></structurelist></popup>\n",
        width, height, length, length / 2);
}

void make_cards(const fs::path& directory, int count) {
    fs::create_directories(directory / "designs");
    std::ofstream manifest(directory / "jobs.jsonl");
    for (int i = 0; i < count; ++i) {
        write_file(directory / fmt::format("designs/{}.xml", i), card(i));
        manifest << fmt::format("{{\"input\": \"designs/{0}.xml\", \"output\": \"out/{0}.svg\"}}\n", i);
    }
}

// Every sample so many times, to sheets and a model.
int make_samples(const fs::path& directory, int copies) {
    fs::create_directories(directory / "designs");
    std::ofstream manifest(directory / "jobs.jsonl");
    int jobs = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(POPUP_SOURCE_DIR) / "samples")) {
        if (entry.path().extension() != ".xml") continue;
        for (int i = 0; i < copies; ++i, ++jobs) {
            const std::string stem = fmt::format("{}{}", entry.path().stem().string(), i);
            fs::copy_file(entry.path(), directory / ("designs/" + stem + ".xml"));
            manifest << fmt::format(
                "{{\"input\": \"designs/{0}.xml\", \"output\": [\"out/{0}.svg\", \"out/{0}.pdf\", "
                "\"out/{0}.glb\"]}}\n",
                stem);
        }
    }
    return jobs;
}

void forget(const fs::path& directory) {
    fs::remove_all(directory / "out");
    fs::remove(directory / "jobs.results.jsonl");
}

int report(int designs) {
    const auto cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    const std::vector<std::string> one{"batch", "jobs.jsonl", "-j1", "-q"};
    const std::vector<std::string> all{"batch", "jobs.jsonl", fmt::format("-j{}", cores), "-q"};
    bool good = true;

    const ScratchDirectory samples;
    const int jobs = make_samples(samples.path(), 20);
    const Cost alone = measured(samples.path(), one);
    forget(samples.path());
    const Cost together = measured(samples.path(), all);
    const Cost again = measured(samples.path(), all);
    good = good && alone.good && together.good && again.good;
    fmt::print("samples to .svg, .pdf and .glb, {} designs\n", jobs);
    fmt::print("  one process        {:8.1f} designs/s, {:.1f} ms of CPU each\n", jobs / alone.seconds,
               1e3 * alone.cpu / jobs);
    fmt::print("  {} processes        {:8.1f} designs/s: {:.0f} % of linear scaling\n", cores,
               jobs / together.seconds, 100.0 * alone.seconds / together.seconds / cores);
    fmt::print("  done already       {:8.2f} ms of CPU each\n", 1e3 * again.cpu / jobs);

    const ScratchDirectory small;
    make_cards(small.path(), 100);
    const Cost hundred = measured(small.path(), all);
    const ScratchDirectory large;
    make_cards(large.path(), designs);
    const Cost many = measured(large.path(), all);
    const Cost fresh = measured(large.path(), all);
    good = good && hundred.good && many.good && fresh.good;
    fmt::print("cards with one box to .svg\n");
    fmt::print("  100 designs        {:8.1f} designs/s, {:6.1f} MB in the largest process\n",
               100 / hundred.seconds, hundred.peak_mb);
    fmt::print("  {:<6} designs     {:8.1f} designs/s, {:6.1f} MB: {:.2f} times that of 100\n", designs,
               designs / many.seconds, many.peak_mb, many.peak_mb / hundred.peak_mb);
    fmt::print("  done already       {:8.1f} designs/s, {:6.1f} MB\n", designs / fresh.seconds,
               fresh.peak_mb);

    // A process a design, as a makefile has it, against a batch: what a start costs.
    double apart = 0.0;
    for (int i = 0; i < 100; ++i) {
        const Cost cost =
            measured(small.path(), {"build", fmt::format("designs/{}.xml", i), "-o", "one.svg"});
        apart += cost.cpu;
        good = good && cost.good;
    }
    fmt::print("  a process each     {:8.1f} ms of CPU each, {:.1f} ms in a batch: {:.0f} % is fixed cost\n",
               10.0 * apart, 1e3 * many.cpu / designs, 100.0 * (1.0 - 100.0 * many.cpu / designs / apart));
    if (!good) fmt::print(stderr, "bench_batch: some run failed\n");
    return good ? 0 : 1;
}

}  // namespace
}  // namespace popup::test

int main(int argc, char** argv) {
    const int designs = argc > 1 ? std::atoi(argv[1]) : 10000;
    if (designs < 1) {
        fmt::print(stderr, "bench_batch [DESIGNS]\n");
        return 2;
    }
    return popup::test::report(designs);
}
