// The files of a batch: its manifest, where its names count from, and what its jobs' results are kept in.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "batch/kept_lines.h"
#include "batch/manifest.h"
#include "batch/results.h"
#include "cli/files/read_files.h"
#include "cli/options/options.h"

namespace popup::cli {

struct BatchFiles {
    std::string name;                  // of the manifest, as given
    std::string directory;             // where the names in it count from; empty: the working directory
    std::string home;                  // the working directory as it was, absolute
    std::optional<Manifest> manifest;  // empty: it is wrong, and that was said

    // `name` so that it means the same wherever the working directory is.
    [[nodiscard]] std::string absolute(const std::string& name) const;
    // The results files that stand beside the manifest, absolute; none for standard input.
    [[nodiscard]] std::vector<std::string> results_beside() const;
    // Goes to the manifest's directory. UsageError when that cannot be done.
    void enter() const;
};

// Reads a manifest; "-" is standard input. nullopt: it cannot be read, and that was said.
std::optional<BatchFiles> open_batch(const std::string& name, std::optional<ManifestForm> form,
                                     const MessageOptions& messages);

// What no job and no report of the batch may overwrite: its manifest, the inputs of all jobs, and what the
// options were read from. To be asked in the directory from which the manifest's names count. Cost: one look
// at the disk an input.
// Precondition: the manifest is sound.
ReadFiles files_of_batch(const BatchFiles& files, const Options& options);

// Declares --manifest-format.
void add_manifest_format_option(CLI::App& verb, Options& options);

// The results file of a run, absolute. UsageError for standard input, which stands beside nothing.
std::string results_for(const std::string& manifest, int shard, int shards);

// A results file that is written to. One process at a time has it.
class ResultsFile {
 public:
    // Opens or makes it, and ends a line that was cut off. Returns its name with links followed. UsageError
    // when it cannot be had.
    std::string open(const std::string& name);
    // Adds the line, unless it is what the file, as `before` knows it, says of the job already. False: it
    // cannot be written.
    bool add(const JobResult& result, const ResultIndex& before);
    // Leaves one line for each job of the manifest that it knows of, in the manifest's order, and nothing
    // else; what is so already is not written again, but for the time of the last change: it is that of the
    // newest run. The old file stays until the new one is complete. Memory: one line.
    bool settle(const Manifest& manifest);
    void close() { lines_.close(); }
    // Why add() or settle() failed.
    [[nodiscard]] const std::string& trouble() const {
        return trouble_.empty() ? lines_.trouble() : trouble_;
    }

 private:
    KeptLines lines_;
    std::string trouble_;
};

}  // namespace popup::cli
