#include "cli/batch/batch_files.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/system/reason.h"
#include "cli/files/read_settings.h"
#include "cli/report.h"

namespace popup::cli {
namespace {

std::string within(const std::string& directory, const std::string& name) {
    return name.starts_with('/') ? name : directory + "/" + name;
}

}  // namespace

std::string BatchFiles::absolute(const std::string& file) const { return within(home, file); }

std::vector<std::string> BatchFiles::results_beside() const {
    return name == "-" ? std::vector<std::string>() : popup::results_beside(absolute(name));
}

void BatchFiles::enter() const {
    if (directory.empty() || ::chdir(directory.c_str()) == 0) return;
    throw UsageError(fmt::format("{}: {}", directory, reason_of(errno)));
}

std::optional<BatchFiles> open_batch(const std::string& name, std::optional<ManifestForm> form,
                                     const MessageOptions& messages) {
    BatchFiles files;
    files.name = name;
    std::error_code error;
    files.home = std::filesystem::current_path(error).string();
    const std::size_t slash = name.rfind('/');
    if (name != "-" && slash != std::string::npos) files.directory = slash == 0 ? "/" : name.substr(0, slash);
    Diagnostics findings(name);
    std::optional<Source> source = read_settings(name, findings, kLongestManifest);
    const bool readable = source.has_value();
    if (source) files.manifest = read_manifest(std::move(*source), form, findings, files.directory);
    if (!findings.sorted().empty()) {
        // Its text is shown, and has gone the way of the rows.
        Diagnostics again;
        if (readable && name != "-") source = read_settings(name, again, kLongestManifest);
        report(messages, {{&findings, readable && source ? std::string_view(source->text) : "", false}},
               Diagnostics());
    }
    if (!readable) return std::nullopt;
    return files;
}

ReadFiles files_of_batch(const BatchFiles& files, const Options& options) {
    ReadFiles read;
    if (files.name != "-") read.add(files.absolute(files.name), "the manifest");
    for (const std::string& name : options.settings_files)
        read.add(files.absolute(name), "which options are read from");
    for (std::size_t i = 0; i < files.manifest->size(); ++i) {
        for (const std::string& name : files.manifest->job(i).inputs) read.add(name, "an input of the batch");
    }
    return read;
}

std::string results_for(const std::string& manifest, int shard, int shards) {
    if (manifest == "-") {
        throw UsageError("a manifest from standard input has no place for its results",
                         {"name one with --results"});
    }
    std::error_code error;
    const std::filesystem::path path = std::filesystem::absolute(manifest, error);
    return results_name(error ? manifest : path.string(), shard, shards);
}

std::string ResultsFile::open(const std::string& name) {
    if (lines_.open(name, kResultBegin)) return lines_.name();
    throw UsageError(fmt::format("{}: {}", name, lines_.trouble()),
                     {"results are kept there; --results FILE names another"});
}

bool ResultsFile::add(const JobResult& result, const ResultIndex& before) {
    const std::string line = to_line(result);
    for (const JobResult& one : before.of(result.key)) {
        if (to_line(one) == line) return true;
    }
    return lines_.add(line);
}

bool ResultsFile::settle(const Manifest& manifest) {
    trouble_.clear();
    Diagnostics trouble;
    ResultIndex index;
    if (!index.add(lines_.name(), trouble)) {
        trouble_ = "it cannot be read again";
        return false;
    }
    std::size_t job = 0;
    std::vector<JobResult> waiting;  // of the job before, the next one last
    return lines_.settle([&]() -> std::optional<std::string> {
        while (waiting.empty() && job < manifest.size()) {
            waiting = index.of(job_key(manifest.job(job++)));
            std::reverse(waiting.begin(), waiting.end());
        }
        if (waiting.empty()) return std::nullopt;
        std::string line = to_line(waiting.back());
        waiting.pop_back();
        return line;
    });
}

}  // namespace popup::cli
