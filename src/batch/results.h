// What became of a batch's jobs: a file with one line of JSON a job, to which lines are only added while jobs
// end, so that nothing that was finished is lost whatever happens. Of several lines on one job the last
// counts.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "batch/manifest.h"
#include "popup/diagnostics.h"

namespace popup {

// done: the outputs were written. failed: the inputs or the options are wrong, and will be until they change.
// unusable: a file could not be read or written. crashed: the worker died of it, twice.
enum class JobStatus { done, failed, unusable, crashed };
std::string_view to_string(JobStatus status);

// A file as it was read or written.
struct FileDigest {
    std::string file;
    std::uint64_t bytes = 0;
    std::string sha256;  // empty: it could not be read
    friend bool operator==(const FileDigest&, const FileDigest&) = default;
};

struct JobResult {
    std::string key;      // of the job, see job_key()
    std::string command;  // digest of version and arguments, see command_digest()
    JobStatus status = JobStatus::done;
    std::vector<FileDigest> inputs;   // whatever the job depends on, looked-for files that were not there too
    std::vector<FileDigest> outputs;  // what it wrote; empty unless done
    std::size_t errors = 0;
    std::size_t warnings = 0;
    std::string diagnostics;  // a JSON list, as --message-format json has its lines
};

// One line of JSON with a line break. Equal results make equal lines: no times, no names of machines.
std::string to_line(const JobResult& result);
inline constexpr std::string_view kResultBegin = "{\"key\":\"";  // of every line
// nullopt when the line is no result: torn, or not ours.
std::optional<JobResult> result_of(std::string_view line);

// What the job is called in results: 32 hexadecimal digits of its row's SHA-256, whatever its place in the
// manifest.
std::string job_key(const BatchJob& job);
// SHA-256 over the program's version and the words of the command.
std::string command_digest(const std::vector<std::string>& words);

// The digest of a file's bytes now; the digest is empty where it cannot be read.
FileDigest digest_of(const std::string& name);
FileDigest digest_of(const std::string& name, std::string_view bytes);
// The digest of a file that was read after `begun`. One that may have been written since is not known: what
// was made of it is not taken for done then.
FileDigest digest_as_read(const std::string& name, std::filesystem::file_time_type begun);

// True when nothing is left to do: the result is of this very command, every file it depends on is as it was,
// those that were not there still missing, and either what it wrote is still there byte for byte, or the
// inputs failed and still would.
bool is_fresh(const JobResult& result, const std::string& command);

// "jobs.jsonl" → "jobs.results.jsonl", shard 2 of 5 "jobs.results.2-of-5.jsonl"; "jobs.csv" →
// "jobs.csv.results.jsonl".
std::string results_name(const std::string& manifest, int shard, int shards);
// All files beside the manifest that have such a name, those that were written to last at the end.
std::vector<std::string> results_beside(const std::string& manifest);

// Files by the time of their last change, the newest last; those of one time stay as they are.
std::vector<std::string> oldest_first(std::vector<std::string> names);

// The results of several files, by job. Keeps places, not lines: 60 bytes a job.
class ResultIndex {
 public:
    // Adds what `name` holds; a file that is not there holds nothing. Lines that are no result, such as one
    // that was cut off as the machine went down, are passed over. False after an error: it is there and
    // cannot be read, or holds none and does not begin as results do.
    bool add(const std::string& name, Diagnostics& diagnostics);
    // The lines on the job, of each file the last, in the order in which the files were added. Reads the
    // files again.
    [[nodiscard]] std::vector<JobResult> of(const std::string& key) const;

 private:
    struct Spot {
        std::uint64_t offset = 0;
        std::uint32_t length = 0;
        std::uint32_t file = 0;
    };
    using Key = std::array<std::uint64_t, 2>;
    struct KeyHash {
        std::size_t operator()(const Key& key) const { return static_cast<std::size_t>(key[0]); }
    };
    static std::optional<Key> key_of(std::string_view text);
    std::vector<std::string> files_;
    std::unordered_multimap<Key, Spot, KeyHash> spots_;
};

}  // namespace popup
