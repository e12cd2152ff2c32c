// One job of a batch, from its row to its result.
#pragma once

#include <string>
#include <vector>

#include "batch/manifest.h"
#include "batch/results.h"
#include "cli/files/read_files.h"

namespace popup::cli {

// What all jobs of a run have in common.
struct BatchRun {
    const Manifest* manifest = nullptr;
    const ResultIndex* known = nullptr;       // what earlier runs left
    std::vector<std::string> common_options;  // stand before each job's own
    bool color = false;
    bool quiet = false;                    // errors only
    bool dry_run = false;                  // nothing is built
    ReadFiles kept;                        // that no job may write: manifest, results, inputs of all jobs
    std::vector<std::string> environment;  // variables that set options, as NAME=VALUE, sorted
};

// Those of this process that change what is built.
std::vector<std::string> setting_variables();

// fresh: an earlier run did it, and nothing has changed since. built: it was done now, well or not. due: it
// would have been done, in a dry run.
enum class JobNews : char { fresh = 'f', built = 'b', due = 'd' };

struct JobReport {
    JobNews news = JobNews::built;
    JobResult result;  // of a job that is due only its key
    std::string text;  // the findings as people read them; of a fresh job only its errors
};

// The words that `popupc` would be called with for the job, "build" first.
std::vector<std::string> job_words(const BatchRun& run, const BatchJob& job);

// Does job `index`, unless it is fresh. Never throws for what the job asks: what is wrong is in the report.
JobReport do_job(const BatchRun& run, std::size_t index);

// The report of a job whose process died of `signal` (0: it ended itself).
JobReport crashed_job(const BatchRun& run, std::size_t index, int signal);

// The report of a job that wrote a file which job `other` has written, too.
JobReport doubled_job(const BatchRun& run, std::size_t index, const std::string& file, std::size_t other);

// A report as bytes, and back.
std::string packed(const JobReport& report);
JobReport unpacked(const std::string& bytes);

}  // namespace popup::cli
