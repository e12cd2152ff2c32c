// Thousands of builds: done by worker processes, written down as they end, and begun again where they were.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "batch/results.h"
#include "cli/batch/batch_files.h"
#include "cli/batch/batch_job.h"
#include "cli/batch/jobserver.h"
#include "cli/batch/worker_pool.h"
#include "cli/options/command_line.h"
#include "cli/options/value_option.h"
#include "cli/progress.h"
#include "cli/report.h"
#include "cli/verbs.h"
#include "popup/files.h"

namespace popup::cli {
namespace {

std::optional<int> whole_number(std::string_view text) {
    const std::optional<double> number = parse_number(text);
    if (!number || *number < 0.0 || *number > 1e9 || *number != static_cast<int>(*number))
        return std::nullopt;
    return static_cast<int>(*number);
}

Shard parse_shard(std::string_view text) {
    const std::size_t slash = text.find('/');
    if (slash != std::string_view::npos) {
        const std::optional<int> number = whole_number(text.substr(0, slash));
        const std::optional<int> count = whole_number(text.substr(slash + 1));
        if (number && count && *number >= 1 && *number <= *count) return {*number, *count};
    }
    throw UsageError(fmt::format("--shard takes I/N with I from 1 to N, not \"{}\"", text),
                     {"such as 2/5: every fifth job from the second on"});
}

// What a Slurm job array says of itself.
Shard shard_of_environment() {
    const auto variable = [](const char* name) -> std::optional<int> {
        const char* text = std::getenv(name);
        if (text == nullptr || *text == '\0') return std::nullopt;
        const std::optional<int> number = whole_number(text);
        if (!number) {
            throw UsageError(fmt::format("{} is \"{}\", which is no whole number", name, text),
                             {"say which part this is with --shard I/N"});
        }
        return number;
    };
    const std::optional<int> id = variable("SLURM_ARRAY_TASK_ID");
    const std::optional<int> count = variable("SLURM_ARRAY_TASK_COUNT");
    if (!id) return {};
    if (!count) {
        throw UsageError(
            fmt::format("this is task {} of a job array, and SLURM_ARRAY_TASK_COUNT does not say of how many",
                        *id),
            {"say which part this is with --shard I/N"});
    }
    const int first = variable("SLURM_ARRAY_TASK_MIN").value_or(1);
    const int step = std::max(1, variable("SLURM_ARRAY_TASK_STEP").value_or(1));
    const Shard shard{(*id - first) / step + 1, *count};
    if (*id >= first && (*id - first) % step == 0 && shard.number <= shard.count) return shard;
    throw UsageError(
        fmt::format("the job array has {} tasks and this is task {}, counted from {} in steps of {}", *count,
                    *id, first, step),
        {"say which part this is with --shard I/N"});
}

struct Tally {
    std::map<JobStatus, std::size_t> ended;
    std::size_t fresh = 0;
    std::vector<std::size_t> due;
    bool lost = false;  // a result could not be written down
};

std::string summary(const Tally& tally, std::size_t jobs, double seconds) {
    std::string text = fmt::format("popupc: {} job{} in {:.1f} s: ", jobs, jobs == 1 ? "" : "s", seconds);
    const auto count = [&tally](JobStatus status) {
        const auto at = tally.ended.find(status);
        return at == tally.ended.end() ? std::size_t{0} : at->second;
    };
    text += fmt::format("{} done", count(JobStatus::done));
    for (const JobStatus status : {JobStatus::failed, JobStatus::unusable, JobStatus::crashed}) {
        if (count(status) > 0) text += fmt::format(", {} {}", count(status), to_string(status));
    }
    const std::size_t tried = jobs - tally.fresh;
    if (tally.fresh > 0) text += fmt::format("; {} as they were", tally.fresh);
    if (tried > 0 && seconds > 0.0) {
        text += fmt::format("; {} tried, {:.1f} a second", tried, static_cast<double>(tried) / seconds);
    }
    return text + "\n";
}

// The options that all jobs share are looked at once, before any job is begun.
void check_common(const std::vector<std::string>& common) {
    std::vector<std::string> words{"build"};
    // Each job finds its own.
    const bool named = std::any_of(common.begin(), common.end(),
                                   [](const std::string& word) { return word.starts_with("--config"); });
    if (!named) words.emplace_back("--no-config");
    words.insert(words.end(), common.begin(), common.end());
    words.insert(words.end(), {"--output=a.svg", "a.xml"});
    const std::variant<Command, std::string> wanted = read_command(std::move(words));
    const Command* command = std::get_if<Command>(&wanted);
    const bool plain = command != nullptr && command->options.inputs.names.size() == 1 &&
                       command->options.build.outputs.size() == 1;
    if (!plain) {
        throw UsageError("what stands behind -- are options of builds, for every job",
                         {"such as: popupc batch jobs.jsonl -- --sheet a4 --profile k40"});
    }
}

std::vector<std::size_t> jobs_of(const Shard& shard, std::size_t count) {
    std::vector<std::size_t> jobs;
    for (auto i = static_cast<std::size_t>(shard.number - 1); i < count;
         i += static_cast<std::size_t>(shard.count)) {
        jobs.push_back(i);
    }
    return jobs;
}

// What killed runs, and workers of this one that were killed, left where it writes.
void clean_up(const Manifest& manifest, const std::string& results) {
    std::set<std::string> directories{std::filesystem::path(results).parent_path().string()};
    for (std::size_t i = 0; i < manifest.size(); ++i) {
        for (const std::string& name : manifest.job(i).outputs) {
            directories.insert(std::filesystem::path(name).parent_path().string());
        }
    }
    for (const std::string& directory : directories) remove_litter(directory);
}

// Hears how jobs end, tells it, and writes it down.
class Scribe {
 public:
    Scribe(const BatchRun& run, ResultsFile& own, const ResultIndex& before, const MessageOptions& messages,
           std::size_t jobs)
        : run_(run),
          own_(own),
          before_(before),
          messages_(messages),
          jobs_(jobs),
          progress_(progress_meter(messages, jobs)) {}

    // False when it cannot be written down: then nothing more may be done.
    bool hear(const JobEnd& end) {
        JobReport report = end.reply ? unpacked(*end.reply) : crashed_job(run_, end.job, end.signal);
        for (const FileDigest& output : report.result.outputs) {
            const auto [at, first] = written_.emplace(file_number(output.file), end.job);
            if (first || at->second == end.job) continue;
            report = doubled_job(run_, end.job, output.file, at->second);
            break;
        }
        if (report.news == JobNews::due) {
            tally.due.push_back(end.job);
        } else {
            ++tally.ended[report.result.status];
            if (report.news == JobNews::fresh) ++tally.fresh;
            // What is added behind a line that was cut off would be lost with it.
            if (!run_.dry_run && !tally.lost) tally.lost = !own_.add(report.result, before_);
        }
        if (!report.text.empty()) say_between(messages_, report.text);
        if (progress_) progress_(++done_, jobs_);
        return !tally.lost;
    }

    Tally tally;

 private:
    const BatchRun& run_;
    ResultsFile& own_;
    const ResultIndex& before_;
    const MessageOptions& messages_;
    std::size_t jobs_;
    std::size_t done_ = 0;
    std::function<void(std::size_t, std::size_t)> progress_;
    std::unordered_map<std::uint64_t, std::size_t> written_;  // by which job each file was
};

// Dies of the signal, as who sent it expects.
int end_interrupted(int signal, const Tally& tally, std::size_t jobs, const MessageOptions& messages) {
    std::size_t ended = 0;
    for (const auto& [status, count] : tally.ended) ended += count;
    say_between(messages,
                fmt::format("popupc: interrupted: {} of {} jobs have ended; the same command goes on from "
                            "there\n",
                            ended, jobs));
    std::raise(signal);
    return exit_unusable;
}

// The rows that have something to do.
std::string rows_of(std::vector<std::size_t> due, const Manifest& manifest) {
    std::sort(due.begin(), due.end());
    std::string rows(due.empty() ? std::string_view() : manifest.heading());
    for (const std::size_t job : due) rows += std::string(manifest.text(job)) + "\n";
    return rows;
}

ExitCode exit_of(const Tally& tally) {
    if (tally.lost || tally.ended.contains(JobStatus::unusable) || tally.ended.contains(JobStatus::crashed)) {
        return exit_unusable;
    }
    return tally.ended.contains(JobStatus::failed) ? exit_findings : exit_done;
}

}  // namespace

void add_manifest_format_option(CLI::App& verb, Options& options) {
    BatchOptions& batch = options.batch;
    value(verb, "--manifest-format", "FORMAT", "jsonl or csv (default: by the manifest's suffix)", "Jobs",
          [&batch](std::string_view text) {
              batch.form =
                  choose<ManifestForm>("--manifest-format", text,
                                       {{"jsonl", ManifestForm::json_lines}, {"csv", ManifestForm::csv}});
          })
        ->configurable(false);
}

CLI::App* add_batch(CLI::App& app, Options& options) {
    CLI::App* verb =
        app.add_subcommand("batch", "Do the builds that a manifest lists; go on where it was left");
    BatchOptions& batch = options.batch;
    verb->add_option("MANIFEST", batch.manifest, "the jobs, as JSON lines or CSV; \"-\" is standard input")
        ->required()
        ->configurable(false)
        ->type_name("");
    verb->add_option("BUILD-OPTIONS", batch.common, "behind \"--\": options of every build")
        ->configurable(false)
        ->type_name("");
    value(*verb, "--shard", "I/N", "every N-th job from the I-th (default: as a Slurm job array says)",
          "Jobs", [&batch](std::string_view text) { batch.shard = parse_shard(text); })
        ->configurable(false);
    value(*verb, "--results", "FILE", "where results are kept (default: beside the manifest)", "Jobs",
          [&batch](std::string_view text) {
              if (text.empty()) throw UsageError("--results takes the name of a file");
              if (text == "-") {
                  throw UsageError("--results takes a file, in which the next run finds what is done",
                                   {"write ./- if that is its name"});
              }
              batch.results = text;
          })
        ->configurable(false);
    add_manifest_format_option(*verb, options);
    verb->add_flag("-n,--dry-run", batch.dry_run, "print the rows that have something to do; do nothing")
        ->configurable(false)
        ->group("Jobs");
    add_talk_options(*verb, options);
    add_thread_option(*verb, options);
    add_print_config_option(*verb, options);
    verb->footer(
        "Examples:\n"
        "  popupc batch jobs.jsonl\n"
        "  popupc batch jobs.csv -j 8 -- --sheet a4 --profile lightburn\n"
        "  popupc batch jobs.jsonl --shard 2/5\n"
        "  popupc batch jobs.jsonl --dry-run > due.jsonl\n"
        "\nA row of JSON lines: {\"input\": \"a.xml\", \"output\": [\"out/a.svg\"], \"options\": \"--sheet "
        "a4\", "
        "\"copies\": 2}\n"
        "As CSV: a first line input,output,options,copies; input and output may be columns several times.\n"
        "Names in a manifest count from its directory. A job that fails does not stop the others.\n"
        "Exit status 0 when all jobs are done, 1 when the inputs of some are wrong, 2 when some could not "
        "be\n"
        "read, written or run.");
    return verb;
}

int run_batch(const Options& options) {
    const BatchOptions& batch = options.batch;
    const Shard shard = batch.shard ? *batch.shard : shard_of_environment();
    std::optional<BatchFiles> files = open_batch(batch.manifest, batch.form, options.messages);
    if (!files) return exit_unusable;
    if (!files->manifest) return exit_unusable;
    const Manifest& manifest = *files->manifest;
    std::string results = batch.results.empty() ? results_for(batch.manifest, shard.number, shard.count)
                                                : files->absolute(batch.results);
    files->enter();
    check_common(batch.common);

    ReadFiles read = files_of_batch(*files, options);
    read.spare(results, "--results");
    ResultsFile own;
    if (!batch.dry_run) results = own.open(results);
    Diagnostics trouble;
    ResultIndex known;
    ResultIndex mine;
    bool readable = mine.add(results, trouble) && known.add(results, trouble);
    for (const std::string& name : files->results_beside()) {
        if (!same_place(name, results)) readable = known.add(name, trouble) && readable;
    }
    if (!readable) {
        report(options.messages, {}, trouble);
        return exit_unusable;
    }
    say(options.messages, "results are kept in " + results);
    if (!batch.dry_run) clean_up(manifest, results);

    BatchRun run;
    run.manifest = &manifest;
    run.known = &known;
    run.common_options = batch.common;
    run.color = colorful(options.messages);
    run.quiet = options.messages.quiet;
    run.dry_run = batch.dry_run;
    run.kept = std::move(read);
    run.kept.add(results, "which results are kept in");
    run.environment = setting_variables();

    const std::vector<std::size_t> jobs = jobs_of(shard, manifest.size());
    Scribe scribe(run, own, mine, options.messages, jobs.size());
    const Tally& tally = scribe.tally;
    PoolOptions pool;
    pool.workers = static_cast<std::size_t>(std::max(1, options.compile.threads));
    // A worker that outlives this process must not keep the next run from the results.
    pool.begun = [&own] { own.close(); };
    // Under make each process but the first needs a token.
    Jobserver jobserver(options.jobs_given ? nullptr : std::getenv("MAKEFLAGS"));
    if (!jobserver.trouble().empty()) say(options.messages, jobserver.trouble());
    ask_before_workers(jobserver, pool);
    const auto begun = std::chrono::steady_clock::now();
    const int signal = run_pool(
        jobs, pool, [&run](std::size_t job) { return packed(do_job(run, job)); },
        [&scribe](const JobEnd& end) { return scribe.hear(end); });
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
    if (batch.dry_run) {
        if (signal != 0) return end_interrupted(signal, tally, jobs.size(), options.messages);
        return print(rows_of(tally.due, manifest)) ? exit_of(tally) : exit_unusable;
    }
    if (tally.lost) {
        report_usage(UsageError(fmt::format("{}: results cannot be written: {}", results, own.trouble()),
                                {"what is written down stays done; run the same command again to go on"}));
    }
    clean_up(manifest, results);
    if (signal != 0) {
        own.close();
        return end_interrupted(signal, tally, jobs.size(), options.messages);
    }
    if (!tally.lost && !own.settle(manifest)) {
        scribe.tally.lost = true;
        report_usage(
            UsageError(fmt::format("{}: results cannot be put in order: {}", results, own.trouble())));
    }
    if (!options.messages.quiet) say_between(options.messages, summary(tally, jobs.size(), took.count()));
    return exit_of(tally);
}

}  // namespace popup::cli
