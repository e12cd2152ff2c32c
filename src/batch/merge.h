// The results of a batch, from however many machines, held against its manifest.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "batch/manifest.h"
#include "batch/results.h"

namespace popup {

// missing: there is no result. gone: there is one, and files it wrote are not there as they were. The others
// are those of the result.
enum class JobState { done, failed, unusable, crashed, missing, gone };
std::string_view to_string(JobState state);

// A file that another job has written, too: of another shard, so that neither noticed.
struct DoubledOutput {
    std::size_t other = 0;  // a row of the manifest
    std::string file;
};

struct MergedJob {
    std::size_t job = 0;  // a row of the manifest
    JobState state = JobState::missing;
    std::string gone = {};                      // a file that is not there as it was
    std::optional<DoubledOutput> doubled = {};  // such a job is unusable
    std::string error = {};                     // the message of its first; may be empty
    std::string error_file = {};                // the file that it is in; may be empty
};

struct MergedReport {
    std::vector<MergedJob> jobs;  // all, in the manifest's order
    std::string json;             // the report, see report_json in the manual
    std::map<JobState, std::size_t> counts;
    [[nodiscard]] bool complete() const { return counts.size() == 1 && counts.contains(JobState::done); }
};

// One result a job: that of the newest run. Files are compared by their bytes, so each is read; relative
// names count from the working directory.
MergedReport merge_results(const Manifest& manifest, const ResultIndex& results);

}  // namespace popup
