// The results of a batch's shards as one report.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include "batch/merge.h"
#include "cli/batch/batch_files.h"
#include "cli/report.h"
#include "cli/verbs.h"
#include "popup/files.h"

namespace popup::cli {
namespace {

constexpr std::size_t kMostNamed = 20;  // jobs that are named one by one

// With the first error; findings that only the run's policy made errors are none. An error in another input
// of the job names it.
std::string not_built(const BatchJob& job, const MergedJob& merged) {
    const std::string& input = job.inputs.front();
    if (merged.error.empty()) return input + " was not built";
    const bool other = merged.error_file != input &&
                       std::find(job.inputs.begin(), job.inputs.end(), merged.error_file) != job.inputs.end();
    return fmt::format("{} was not built: {}{}{}", input, other ? merged.error_file : "", other ? ": " : "",
                       merged.error);
}

void tell_job(const MergedJob& merged, const Manifest& manifest, Diagnostics& findings) {
    const BatchJob job = manifest.job(merged.job);
    const Place place = manifest.place(merged.job);
    const std::string& input = job.inputs.front();
    switch (merged.state) {
        case JobState::done:
            return;
        case JobState::missing:
            findings.error("job-missing", place, fmt::format("{} has not been built", input))
                .hint("run popupc batch on the manifest again: it does what is missing");
            return;
        case JobState::gone:
            findings
                .error("job-missing", place,
                       fmt::format("{} was built, but {} is not there as it was written", input, merged.gone))
                .hint("run popupc batch on the manifest again: it does what is missing");
            return;
        case JobState::failed:
            findings.error("job-failed", place, not_built(job, merged))
                .hint("-o FILE writes the report, which has all that was found; mend the design");
            return;
        case JobState::unusable:
            if (merged.doubled) {
                findings
                    .error("bad-job", place,
                           fmt::format("{} is written by another job, too, so that neither can be relied on",
                                       merged.doubled->file))
                    .with(manifest.place(merged.doubled->other), "the other job");
                return;
            }
            findings.error("job-failed", place, not_built(job, merged))
                .hint("-o FILE writes the report, which has all that went wrong");
            return;
        case JobState::crashed:
            findings.error("job-crashed", place, fmt::format("the process that built {} died twice", input));
            return;
    }
}

// What is written over nothing that the batch has: its manifest, its results, its jobs' files.
void check_free(const std::string& path, const std::string& shown, const Manifest& manifest,
                const ReadFiles& read) {
    if (manifest.taken_by(path, manifest.size()))
        throw UsageError(fmt::format("{} is a file of the batch, and would be written over", shown));
    read.spare(path, "a report");
}

// The rows keep their names, which count from the directory of their manifest.
void check_beside(const std::string& path, const std::string& shown, const std::string& manifest_path) {
    std::error_code error;
    const auto directory = [&error](const std::string& name) {
        return std::filesystem::weakly_canonical(std::filesystem::path(name).parent_path(), error);
    };
    if (path == "-" || directory(path) == directory(manifest_path)) return;
    throw UsageError(
        fmt::format("{} is to be a manifest in another directory, from which its names would count", shown),
        {"write it beside " + manifest_path});
}

}  // namespace

CLI::App* add_merge_reports(CLI::App& app, Options& options) {
    CLI::App* verb = app.add_subcommand(
        "merge-reports", "Join the results of a batch's shards to one report; say what is missing");
    MergeOptions& merge = options.merge;
    verb->add_option("MANIFEST", merge.manifest, "the batch's manifest")
        ->required()
        ->configurable(false)
        ->type_name("");
    verb->add_option("RESULTS", merge.results, "results files (default: all beside the manifest)")
        ->configurable(false)
        ->type_name("");
    verb->add_option("-o,--output", merge.output, "write the report here, as JSON; \"-\" is standard output")
        ->configurable(false)
        ->type_name("FILE")
        ->group("Output");
    verb->add_option("--missing", merge.missing,
                     "write the rows of the jobs that are not done, as a manifest")
        ->configurable(false)
        ->type_name("FILE")
        ->group("Output");
    add_manifest_format_option(*verb, options);
    add_talk_options(*verb, options);
    add_print_config_option(*verb, options);
    verb->footer(
        "Examples:\n"
        "  popupc merge-reports jobs.jsonl -o report.json\n"
        "  popupc merge-reports jobs.jsonl --missing again.jsonl\n"
        "\nExit status 0 when every job is done and its files are there, 1 when not.");
    return verb;
}

int run_merge_reports(const Options& options) {
    const MergeOptions& merge = options.merge;
    if (merge.manifest == "-") {
        throw UsageError("merge-reports reads its manifest from a file, and - names none",
                         {"such as: popupc merge-reports jobs.jsonl -o report.json"});
    }
    if (is_standard_output(merge.output) && is_standard_output(merge.missing)) {
        throw UsageError("standard output has two users: the report and the rows of what is missing",
                         {"-o FILE or --missing FILE takes one of them"});
    }
    std::optional<BatchFiles> files = open_batch(merge.manifest, options.batch.form, options.messages);
    if (!files) return exit_unusable;
    if (!files->manifest) return exit_unusable;
    const Manifest& manifest = *files->manifest;
    Diagnostics findings(merge.manifest);
    ResultIndex results;
    bool readable = true;
    std::vector<std::string> names;
    for (const std::string& name : merge.results) {
        names.push_back(files->absolute(name));
        if (digest_of(name).sha256.empty()) {
            findings.error("unreadable-input", {}, name + " cannot be read");
            readable = false;
        }
    }
    names = names.empty() ? files->results_beside() : oldest_first(std::move(names));
    for (const std::string& name : names) readable = results.add(name, findings) && readable;
    if (!readable) {
        report(options.messages, {{&findings, {}}}, Diagnostics());
        return exit_unusable;
    }
    const std::string manifest_path = files->absolute(merge.manifest);
    std::vector<PendingFile> written;
    const auto place = [&](const std::string& name) { return name == "-" ? name : files->absolute(name); };
    const std::string output = place(merge.output);
    const std::string missing = place(merge.missing);
    files->enter();
    ReadFiles read = files_of_batch(*files, options);
    for (const std::string& name : names) read.add(name, "which has results");
    for (std::size_t i = 0; i < manifest.size(); ++i) {
        for (const std::string& name : manifest.job(i).outputs) read.add(name, "an output of the batch");
    }
    if (!merge.output.empty()) check_free(output, merge.output, manifest, read);
    if (!merge.missing.empty()) {
        check_free(missing, merge.missing, manifest, read);
        check_beside(missing, merge.missing, manifest_path);
    }
    MergedReport merged = merge_results(manifest, results);

    std::string again(manifest.heading());
    std::size_t told = 0;
    for (const MergedJob& job : merged.jobs) {
        if (job.state == JobState::done) continue;
        again += std::string(manifest.text(job.job)) + "\n";
        if (++told <= kMostNamed) tell_job(job, manifest, findings);
    }
    if (!merge.output.empty()) written.push_back({output, std::move(merged.json)});
    if (!merge.missing.empty()) written.push_back({missing, told > 0 ? std::move(again) : std::string()});
    Diagnostics trouble;
    const bool good = write_all(written, false, trouble);
    report(options.messages, {{&findings, manifest.text(), false}}, trouble);
    if (!options.messages.quiet) {
        std::string text = fmt::format("popupc: {} job{}", manifest.size(), manifest.size() == 1 ? "" : "s");
        char separator = ':';
        for (const auto& [state, count] : merged.counts) {
            text += fmt::format("{} {} {}", separator, count, to_string(state));
            separator = ',';
        }
        if (told > kMostNamed) text += fmt::format("; {} of them are not named here", told - kMostNamed);
        say_between(options.messages, text + "\n");
    }
    if (!good) return exit_unusable;
    return merged.complete() ? exit_done : exit_findings;
}

}  // namespace popup::cli
