#include "batch/merge.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "popup/compile.h"

namespace popup {
namespace {

using nlohmann::ordered_json;

JobState state_of(JobStatus status) {
    switch (status) {
        case JobStatus::done:
            return JobState::done;
        case JobStatus::failed:
            return JobState::failed;
        case JobStatus::unusable:
            return JobState::unusable;
        case JobStatus::crashed:
            return JobState::crashed;
    }
    broken_invariant("a job has one of four ends", __FILE__, __LINE__);
}

// The first output that is not there with the size, or the bytes, it had; empty when all are.
std::string gone_output(const JobResult& result, bool bytes) {
    for (const FileDigest& output : result.outputs) {
        std::error_code error;
        if (std::filesystem::file_size(output.file, error) != output.bytes || error) return output.file;
        if (bytes && digest_of(output.file) != output) return output.file;
    }
    return {};
}

// How much a state is worth; of two results the better one tells what became of the job.
int rank(JobState state) {
    switch (state) {
        case JobState::done:
            return 5;
        case JobState::failed:
            return 4;
        case JobState::unusable:
            return 3;
        case JobState::crashed:
            return 2;
        case JobState::gone:
            return 1;
        case JobState::missing:
            return 0;
    }
    broken_invariant("a job has one of six states", __FILE__, __LINE__);
}

}  // namespace

std::string_view to_string(JobState state) {
    switch (state) {
        case JobState::done:
            return "done";
        case JobState::failed:
            return "failed";
        case JobState::unusable:
            return "unusable";
        case JobState::crashed:
            return "crashed";
        case JobState::missing:
            return "missing";
        case JobState::gone:
            return "gone";
    }
    broken_invariant("a job has one of six states", __FILE__, __LINE__);
}

MergedReport merge_results(const Manifest& manifest, const ResultIndex& results) {
    MergedReport report;
    std::map<std::string, std::size_t> codes;
    std::string rows;
    for (std::size_t i = 0; i < manifest.size(); ++i) {
        const BatchJob job = manifest.job(i);
        MergedJob merged{i, JobState::missing, {}};
        std::optional<JobResult> best;
        std::vector<JobResult> all = results.of(job_key(job));
        for (JobResult& one : all) {
            // Runs with different options may have left files of one size; then the bytes tell them apart.
            const std::string gone = gone_output(one, all.size() > 1);
            const JobState state = gone.empty() ? state_of(one.status) : JobState::gone;
            if (best && rank(state) <= rank(merged.state)) continue;
            merged = {i, state, gone};
            best = std::move(one);
        }
        ++report.counts[merged.state];
        ordered_json row;
        row["line"] = manifest.place(i).line;
        row["state"] = to_string(merged.state);
        row["inputs"] = job.inputs;
        if (best) {
            ordered_json outputs = ordered_json::array();
            for (const FileDigest& file : best->outputs) {
                outputs.push_back({{"file", file.file}, {"bytes", file.bytes}, {"sha256", file.sha256}});
            }
            row["outputs"] = std::move(outputs);
            row["errors"] = best->errors;
            row["warnings"] = best->warnings;
            row["diagnostics"] = ordered_json::parse(best->diagnostics);
            for (const ordered_json& one : row["diagnostics"]) ++codes[one.value("code", std::string())];
        } else {
            row["outputs"] = nullptr;
            row["errors"] = nullptr;
            row["warnings"] = nullptr;
            row["diagnostics"] = nullptr;
        }
        rows += (rows.empty() ? "  " : ",\n  ") +
                row.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
        report.jobs.push_back(std::move(merged));
    }
    ordered_json head;
    head["version"] = version();
    head["manifest"] = manifest.name();
    head["jobs"] = manifest.size();
    for (const JobState state : {JobState::done, JobState::failed, JobState::unusable, JobState::crashed,
                                 JobState::missing, JobState::gone}) {
        head[std::string(to_string(state))] = report.counts.contains(state) ? report.counts.at(state) : 0;
    }
    head["codes"] = codes;
    std::string text = head.dump(2, ' ', false, ordered_json::error_handler_t::replace);
    text.resize(text.size() - 2);  // the brace and its line break; the rows go before it, a line each
    report.json = std::move(text) + ",\n  \"results\": [\n" + rows + "\n  ]\n}\n";
    return report;
}

}  // namespace popup
