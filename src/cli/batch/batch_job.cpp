#include "cli/batch/batch_job.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstring>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>
#include <variant>

#include "base/diagnostics/render_diagnostics.h"
#include "cli/build.h"
#include "cli/options/command_line.h"
#include "cli/options/config_file.h"
#include "cli/options/dependency_options.h"
#include "popup/files.h"

namespace popup::cli {
namespace {

using nlohmann::ordered_json;

// Findings of a job that never became a build: its words are wrong.
Diagnostics misused(const BatchRun& run, std::size_t index, const UsageError& error) {
    Diagnostics findings(run.manifest->name());
    Diagnostic& one = findings.error("bad-job", run.manifest->place(index), error.what());
    for (const std::string& hint : error.hints()) one.hint(hint);
    return findings;
}

// A job writes files, the ones it says it writes, and nothing else.
void check_command(const Options& options, const BatchJob& job) {
    if (options.build.emit || !options.messages.file.empty() || options.build.watch ||
        is_standard_output(options.print.file)) {
        throw UsageError("a job of a batch has no output but its files",
                         {"--emit, --diagnostics, --watch and --print - are for single builds"});
    }
    if (options.build.outputs != job.outputs) {
        throw UsageError("the options of a job name an output", {"outputs stand in \"output\""});
    }
    std::vector<std::string> outputs = job.outputs;
    if (options.build.dependencies.wanted) outputs.push_back(dependency_file_name(options));
    if (!options.print.file.empty()) outputs.push_back(options.print.file);
    for (const std::string& name : outputs) {
        if (is_standard_output(name) || name.starts_with("/dev/")) {
            throw UsageError(fmt::format("{} is no file that a job could write", name));
        }
    }
    for (const std::string& name : job.outputs) {
        for (const Format& format : format_table()) {
            const std::size_t at = name.find(format.suffix);
            const std::size_t end = at + format.suffix.size();
            if (at == std::string::npos || end >= name.size()) continue;
            if (std::string_view(" ;,|").find(name[end]) == std::string_view::npos) continue;
            throw UsageError(fmt::format("\"{}\" looks like several names", name),
                             {"several outputs are a list in JSON, and columns of their own in CSV"});
        }
    }
    for (const std::string& name : options.inputs.names) {
        if (name == "-") throw UsageError("a job of a batch has no standard input");
    }
}

// What is known of names only now: further sheets, dependency files.
void check_files(const BatchRun& run, std::size_t index, const std::vector<PendingFile>& files) {
    for (const PendingFile& file : files) {
        run.kept.spare(file.path, "this job");
        if (const auto other = run.manifest->taken_by(file.path, index)) {
            throw UsageError(
                fmt::format("{} would be written, and the job of line {} has a file of that name", file.path,
                            run.manifest->place(*other).line),
                {"further sheets are numbered: card-2.svg; give one of the jobs another name"});
        }
    }
}

// The command that the words are, read while the files that settings come from stayed the same, and their
// digests.
Command read_settled(const std::vector<std::string>& words, std::vector<FileDigest>& settings) {
    for (;;) {
        std::variant<Command, std::string> wanted = read_command(words);
        Command* command = std::get_if<Command>(&wanted);
        if (command == nullptr) {
            throw UsageError("the options of a job ask for something to be printed, and for no build");
        }
        std::vector<FileDigest> now;
        for (const std::string& name : command->options.settings_files) now.push_back(digest_of(name));
        // Without such files there is nothing to look at twice.
        if (now == settings) {
            // What is said for all jobs need not concern each of them.
            command->options.given.clear();
            return std::move(*command);
        }
        settings = std::move(now);
    }
}

// The findings in JSON, counted, and as text.
void tell(JobReport& report, const BatchRun& run, const std::vector<FileFindings>& files) {
    ordered_json list = ordered_json::array();
    for (const FileFindings& file : files) {
        PlaceFinder finder(file.text);
        for (const Diagnostic& one : file.diagnostics->sorted()) {
            list.push_back(to_json(one));
            if (one.severity == Severity::error) ++report.result.errors;
            if (one.severity == Severity::warning) ++report.result.warnings;
            const Severity least = run.quiet ? Severity::error : Severity::warning;
            if (one.severity >= least) report.text += render_text(one, finder, run.color);
        }
    }
    report.result.diagnostics = list.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

// The errors of an earlier run, whose sources are not at hand.
std::string remembered(const JobResult& result, bool color) {
    std::string text;
    if (result.status == JobStatus::done) return text;
    for (const ordered_json& row : ordered_json::parse(result.diagnostics)) {
        const auto word = [&row](const char* key) {
            const auto at = row.find(key);
            return at != row.end() && at->is_string() ? at->get<std::string>() : std::string();
        };
        const auto number = [&row](const char* key) {
            const auto at = row.find(key);
            return at != row.end() && at->is_number_integer() ? at->get<int>() : 0;
        };
        if (word("severity") != "error") continue;
        Diagnostic one;
        one.code = word("code");
        one.file = word("file");
        one.message = word("message");
        one.place = {number("line"), number("column")};
        text += render_short(one, color);
    }
    return text;
}

// By this a result is known to be of the same command: its words, and where its settings come from. What they
// say is in the files that count as inputs.
std::string digest_of_command(const BatchRun& run, const BatchJob& job,
                              const std::vector<std::string>& words) {
    std::vector<std::string> all = run.environment;
    for (const std::string& input : job.inputs) all.push_back(find_config(input).value_or(std::string()));
    all.insert(all.end(), words.begin(), words.end());
    return command_digest(all);
}

void make_directories(const std::vector<std::string>& outputs) {
    for (const std::string& name : outputs) {
        std::error_code error;  // that it cannot be made is told when the file cannot be written
        const std::filesystem::path directory = std::filesystem::path(name).parent_path();
        if (!directory.empty()) std::filesystem::create_directories(directory, error);
    }
}

// The digests of what the build read: of what it holds in memory, else those that were taken as it was read.
std::vector<FileDigest> digests_of(const Build& build, const std::vector<FileDigest>& settings,
                                   std::filesystem::file_time_type begun) {
    std::vector<FileDigest> files;
    for (const std::string& name : build.inputs) {
        const auto known = std::find_if(settings.begin(), settings.end(),
                                        [&name](const FileDigest& one) { return one.file == name; });
        const std::string* text = nullptr;
        for (const CompiledDesign& one : build.run.compilation.designs) {
            if (one.source.name == name) text = &one.source.text;
        }
        if (build.profile && build.profile->readable && build.profile->source.name == name) {
            text = &build.profile->source.text;
        }
        if (text != nullptr) {
            files.push_back(digest_of(name, *text));
        } else if (known != settings.end()) {
            files.push_back(*known);
        } else {
            files.push_back(digest_as_read(name, begun));
        }
    }
    for (const std::string& name : build.missing) files.push_back({name, 0, {}});
    return files;
}

// The report of a job that came to nothing for a reason outside its build.
JobReport spoilt_job(const BatchRun& run, const BatchJob& job, JobStatus status,
                     const Diagnostics& findings) {
    JobReport report;
    report.result.key = job_key(job);
    report.result.command = digest_of_command(run, job, job_words(run, job));
    report.result.status = status;
    tell(report, run, {{&findings, run.manifest->text()}});
    return report;
}

JobStatus status_of(ExitCode code) {
    switch (code) {
        case exit_done:
            return JobStatus::done;
        case exit_findings:
            return JobStatus::failed;
        case exit_unusable:
            return JobStatus::unusable;
    }
    broken_invariant("a build has one of three ends", __FILE__, __LINE__);
}

}  // namespace

std::vector<std::string> setting_variables() {
    // How much is said, and how much is done at a time, changes no result.
    static constexpr std::string_view kOthers[] = {
        "POPUPC_JOBS=", "POPUPC_PROGRESS=", "POPUPC_COLOR=", "POPUPC_QUIET=", "POPUPC_VERBOSE="};
    std::vector<std::string> variables;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string_view text(*entry);
        if (!text.starts_with("POPUPC_") && !text.starts_with("SOURCE_DATE_EPOCH=")) continue;
        const bool other = std::any_of(std::begin(kOthers), std::end(kOthers),
                                       [text](std::string_view one) { return text.starts_with(one); });
        if (!other) variables.emplace_back(text);
    }
    std::sort(variables.begin(), variables.end());
    return variables;
}

std::vector<std::string> job_words(const BatchRun& run, const BatchJob& job) {
    std::vector<std::string> words{"build", "-j1"};
    if (job.copies) words.push_back(fmt::format("--copies={}", *job.copies));
    for (const std::string& output : job.outputs) words.push_back("--output=" + output);
    // Last: an option without its value would take the next word for it.
    words.insert(words.end(), run.common_options.begin(), run.common_options.end());
    words.insert(words.end(), job.options.begin(), job.options.end());
    words.emplace_back("--");
    for (const std::string& input : job.inputs) {
        // "@name" would be a file of arguments.
        words.push_back(input.starts_with('@') ? "./" + input : input);
    }
    return words;
}

JobReport do_job(const BatchRun& run, std::size_t index) {
    const BatchJob job = run.manifest->job(index);
    JobReport report;
    JobResult& result = report.result;
    result.key = job_key(job);
    try {
        const std::vector<std::string> words = job_words(run, job);
        result.command = digest_of_command(run, job, words);
        for (JobResult& known : run.known->of(result.key)) {
            if (!is_fresh(known, result.command)) continue;
            report.news = JobNews::fresh;
            report.result = std::move(known);
            report.text = remembered(report.result, run.color);
            return report;
        }
        if (run.dry_run) {
            report.news = JobNews::due;
            return report;
        }
        std::vector<FileDigest> settings;
        Options options = read_settled(words, settings).options;
        check_command(options, job);
        options.build.before_writing = [&](const std::vector<PendingFile>& files) {
            check_files(run, index, files);
        };
        // An interrupt lets the job come to its end as it would have: what is cut short is another result.
        static const std::atomic<bool> kNever{false};
        options.compile.layout.nesting.stop = &kNever;
        // The process that shares out the jobs is the one that asks make.
        options.jobs_given = true;
        options.compile.output.threads = 1;
        make_directories(job.outputs);
        const auto begun = std::filesystem::file_time_type::clock::now();
        const Build built = build(options);
        result.status = status_of(built.status);
        result.inputs = digests_of(built, settings, begun);
        for (const PendingFile& file : built.files)
            result.outputs.push_back(digest_of(file.path, file.bytes));
        std::vector<FileFindings> findings = built.findings();
        findings.push_back({&built.run.compilation.run_diagnostics, {}});
        if (options.print.file.empty()) report.text = shown_on_terminal(printed_text(built.run));
        tell(report, run, findings);
        // The findings name the input; which row it was is told last.
        if (result.status != JobStatus::done) {
            Diagnostics row(run.manifest->name());
            row.error("job-failed", run.manifest->place(index),
                      fmt::format("{} was not built", job.outputs.front()));
            report.text += render_short(row.sorted().front(), run.color);
        }
    } catch (const UsageError& error) {
        const Diagnostics findings = misused(run, index, error);
        // Whether it is the words or a file that is wrong is not known: it is tried anew.
        result.status = JobStatus::unusable;
        tell(report, run, {{&findings, run.manifest->text()}});
    }
    return report;
}

JobReport crashed_job(const BatchRun& run, std::size_t index, int signal) {
    const BatchJob job = run.manifest->job(index);
    Diagnostics findings(run.manifest->name());
    findings
        .error("job-crashed", run.manifest->place(index),
               fmt::format("the process that built {} died twice{}", job.inputs.front(),
                           signal == 0 ? std::string()
                                       : fmt::format(", by signal {} ({})", signal, ::strsignal(signal))))
        .hint(signal == SIGKILL ? "the system may have run out of memory: try fewer processes with -j"
                                : "please report it with this input; other jobs went on");
    return spoilt_job(run, job, JobStatus::crashed, findings);
}

JobReport doubled_job(const BatchRun& run, std::size_t index, const std::string& file, std::size_t other) {
    Diagnostics findings(run.manifest->name());
    findings
        .error("bad-job", run.manifest->place(index),
               fmt::format("{} is written by another job, too, so that neither can be relied on", file))
        .with(run.manifest->place(other), "the other job")
        .hint("further sheets are numbered (card-2.svg), and -MD names its file after the first output");
    return spoilt_job(run, run.manifest->job(index), JobStatus::unusable, findings);
}

std::string packed(const JobReport& report) {
    return static_cast<char>(report.news) + to_line(report.result) + report.text;
}

JobReport unpacked(const std::string& bytes) {
    const std::size_t end = bytes.find('\n');
    POPUP_INVARIANT(!bytes.empty() && end != std::string::npos);
    std::optional<JobResult> result = result_of(std::string_view(bytes).substr(1, end - 1));
    POPUP_INVARIANT(result.has_value());
    return {static_cast<JobNews>(bytes.front()), std::move(*result), bytes.substr(end + 1)};
}

}  // namespace popup::cli
