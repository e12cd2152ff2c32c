#include "cli/batch_job.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstring>
#include <exception>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>
#include <variant>

#include "base/render_diagnostics.h"
#include "cli/build.h"
#include "cli/command_line.h"
#include "cli/config_file.h"

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
    const bool talks =
        options.build.emit || options.messages.use_standard_output() || !options.messages.file.empty();
    if (talks) {
        throw UsageError("a job of a batch has no output but its files",
                         {"--emit, --message-format and --diagnostics are for single builds"});
    }
    if (options.build.outputs != job.outputs) {
        throw UsageError("the options of a job name an output", {"outputs stand in \"output\""});
    }
    for (const std::string& name : job.outputs) {
        if (name == "-" || name.starts_with("/dev/")) {
            throw UsageError(fmt::format("{} is no file that a job could write", name));
        }
    }
    for (const std::string& name : options.inputs.names) {
        if (name == "-") throw UsageError("a job of a batch has no standard input");
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
        if (row.value("severity", "") != "error") continue;
        Diagnostic one;
        const auto word = [&row](const char* key) {
            const auto at = row.find(key);
            return at != row.end() && at->is_string() ? at->get<std::string>() : std::string();
        };
        const auto number = [&row](const char* key) {
            const auto at = row.find(key);
            return at != row.end() && at->is_number_integer() ? at->get<int>() : 0;
        };
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
    all.push_back(find_config(job.inputs.front()).value_or(std::string()));
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

// The digests of what the build read: of what it holds in memory, else of the file.
std::vector<FileDigest> digests_of(const Build& build) {
    std::vector<FileDigest> files;
    for (const std::string& name : build.inputs) {
        const std::string* text = nullptr;
        for (const CompiledDesign& one : build.run.compilation.designs) {
            if (one.source.name == name) text = &one.source.text;
        }
        if (build.profile && build.profile->readable && build.profile->source.name == name) {
            text = &build.profile->source.text;
        }
        files.push_back(text != nullptr ? digest_of(name, *text) : digest_of(name));
    }
    return files;
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
    std::vector<std::string> variables;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        if (std::string_view(*entry).starts_with("POPUPC_")) variables.emplace_back(*entry);
    }
    std::sort(variables.begin(), variables.end());
    return variables;
}

std::vector<std::string> job_words(const BatchRun& run, const BatchJob& job) {
    std::vector<std::string> words{"build", "-j1"};
    words.insert(words.end(), run.common_options.begin(), run.common_options.end());
    words.insert(words.end(), job.options.begin(), job.options.end());
    if (job.copies) words.push_back(fmt::format("--copies={}", *job.copies));
    for (const std::string& output : job.outputs) words.push_back("--output=" + output);
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
        std::vector<std::string> words = job_words(run, job);
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
        const std::variant<Command, std::string> wanted = read_command(std::move(words));
        const Command* command = std::get_if<Command>(&wanted);
        if (command == nullptr) throw UsageError("the options of a job ask for help");
        check_command(command->options, job);
        make_directories(job.outputs);
        const Build built = build(command->options);
        result.status = status_of(built.status);
        result.inputs = digests_of(built);
        for (const PendingFile& file : built.files)
            result.outputs.push_back(digest_of(file.path, file.bytes));
        std::vector<FileFindings> findings = built.findings();
        findings.push_back({&built.run.compilation.run_diagnostics, {}});
        tell(report, run, findings);
    } catch (const UsageError& error) {
        const Diagnostics findings = misused(run, index, error);
        // Whether it is the words or a file that is wrong is not known: it is tried anew.
        result.status = JobStatus::unusable;
        tell(report, run, {{&findings, {}}});
    }
    return report;
}

JobReport crashed_job(const BatchRun& run, std::size_t index, int signal) {
    const BatchJob job = run.manifest->job(index);
    JobReport report;
    report.result.key = job_key(job);
    report.result.command = digest_of_command(run, job, job_words(run, job));
    report.result.status = JobStatus::crashed;
    Diagnostics findings(run.manifest->name());
    findings
        .error("job-crashed", run.manifest->place(index),
               fmt::format("the process that built {} died twice{}", job.inputs.front(),
                           signal == 0 ? std::string()
                                       : fmt::format(", by signal {} ({})", signal, ::strsignal(signal))))
        .hint(signal == SIGKILL ? "the system may have run out of memory: try fewer processes with -j"
                                : "please report it with this input; other jobs went on");
    tell(report, run, {{&findings, {}}});
    return report;
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
