#include "batch/merge.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>
#include <tuple>
#include <unordered_map>
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

// The first output that is not there with the bytes it had; empty when all are.
std::string gone_output(const JobResult& result) {
    for (const FileDigest& output : result.outputs) {
        std::error_code error;
        if (std::filesystem::file_size(output.file, error) != output.bytes || error) return output.file;
        if (digest_of(output.file) != output) return output.file;
    }
    return {};
}

// The message of the first error in what a job found, and the file that it is of; empty: there is none.
std::pair<std::string, std::string> first_error(const ordered_json& findings) {
    const auto word = [](const ordered_json& finding, const char* key) {
        const auto at = finding.find(key);
        return at != finding.end() && at->is_string() ? at->get<std::string>() : std::string();
    };
    for (const ordered_json& one : findings) {
        if (word(one, "severity") == "error") return {word(one, "message"), word(one, "file")};
    }
    return {};
}

// Jobs of different shards cannot see what the others write: the first of two that wrote one file, and the
// file.
class Writers {
 public:
    std::optional<DoubledOutput> doubled(std::size_t job, const JobResult& result) {
        for (const FileDigest& output : result.outputs) {
            const auto [at, first] = written_.emplace(file_number(output.file), job);
            if (!first && at->second != job) return DoubledOutput{at->second, output.file};
        }
        return std::nullopt;
    }

 private:
    std::unordered_map<std::uint64_t, std::size_t> written_;
};

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
    Writers writers;
    for (std::size_t i = 0; i < manifest.size(); ++i) {
        const BatchJob job = manifest.job(i);
        MergedJob merged{i};
        const std::vector<JobResult> all = results.of(job_key(job));
        const JobResult* const best = all.empty() ? nullptr : &all.back();
        if (best != nullptr) {
            merged.doubled = writers.doubled(i, *best);
            merged.gone = gone_output(*best);
            merged.state = merged.doubled        ? JobState::unusable
                           : merged.gone.empty() ? state_of(best->status)
                                                 : JobState::gone;
        }
        ++report.counts[merged.state];
        ordered_json row;
        row["line"] = manifest.place(i).line;
        row["state"] = to_string(merged.state);
        row["inputs"] = job.inputs;
        if (best != nullptr) {
            ordered_json outputs = ordered_json::array();
            for (const FileDigest& file : best->outputs) {
                outputs.push_back({{"file", file.file}, {"bytes", file.bytes}, {"sha256", file.sha256}});
            }
            row["outputs"] = std::move(outputs);
            row["errors"] = best->errors;
            row["warnings"] = best->warnings;
            row["diagnostics"] = ordered_json::parse(best->diagnostics);
            std::tie(merged.error, merged.error_file) = first_error(row["diagnostics"]);
            for (const ordered_json& one : row["diagnostics"]) {
                const auto code = one.find("code");
                if (code != one.end() && code->is_string()) ++codes[code->get<std::string>()];
            }
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
