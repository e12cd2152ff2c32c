#include "batch/results.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "base/system/digest.h"
#include "popup/compile.h"

namespace popup {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kKeyDigits = 32;
constexpr JobStatus kStatuses[] = {JobStatus::done, JobStatus::failed, JobStatus::unusable,
                                   JobStatus::crashed};

std::string dumped(const ordered_json& json) {
    return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

ordered_json json_of(const std::vector<FileDigest>& files) {
    ordered_json list = ordered_json::array();
    for (const FileDigest& one : files) {
        list.push_back({{"file", one.file}, {"bytes", one.bytes}, {"sha256", one.sha256}});
    }
    return list;
}

// A count; throws where it is negative, broken or no number. To convert such a number is undefined.
std::uint64_t count_of(const ordered_json& value) {
    return value.get_ref<const ordered_json::number_unsigned_t&>();
}

std::vector<FileDigest> files_of(const ordered_json& list) {
    std::vector<FileDigest> files;
    for (const ordered_json& one : list) {
        files.push_back({one.at("file").get<std::string>(), count_of(one.at("bytes")),
                         one.at("sha256").get<std::string>()});
    }
    return files;
}

// Directory, with its slash, and what results are called after.
std::pair<std::string, std::string> parts_of(const std::string& manifest) {
    const std::size_t slash = manifest.rfind('/');
    const std::size_t begin = slash == std::string::npos ? 0 : slash + 1;
    std::string stem = manifest.substr(begin);
    if (constexpr std::string_view kSuffix = ".jsonl"; stem.ends_with(kSuffix) && stem != kSuffix) {
        stem.resize(stem.size() - kSuffix.size());
    }
    return {manifest.substr(0, begin), std::move(stem)};
}

}  // namespace

std::string_view to_string(JobStatus status) {
    switch (status) {
        case JobStatus::done:
            return "done";
        case JobStatus::failed:
            return "failed";
        case JobStatus::unusable:
            return "unusable";
        case JobStatus::crashed:
            return "crashed";
    }
    broken_invariant("a job has one of four ends", __FILE__, __LINE__);
}

std::string to_line(const JobResult& result) {
    ordered_json line;
    line["key"] = result.key;
    line["command"] = result.command;
    line["status"] = to_string(result.status);
    line["inputs"] = json_of(result.inputs);
    line["outputs"] = json_of(result.outputs);
    line["errors"] = result.errors;
    line["warnings"] = result.warnings;
    line["diagnostics"] = ordered_json::parse(result.diagnostics.empty() ? "[]" : result.diagnostics);
    return dumped(line) + "\n";
}

std::optional<JobResult> result_of(std::string_view line) {
    const ordered_json read = ordered_json::parse(line, nullptr, false);
    if (read.is_discarded()) return std::nullopt;
    try {
        JobResult result;
        result.key = read.at("key").get<std::string>();
        result.command = read.at("command").get<std::string>();
        const std::string status = read.at("status").get<std::string>();
        const auto* const known = std::find_if(std::begin(kStatuses), std::end(kStatuses),
                                               [&](JobStatus one) { return to_string(one) == status; });
        if (known == std::end(kStatuses)) return std::nullopt;
        result.status = *known;
        result.inputs = files_of(read.at("inputs"));
        result.outputs = files_of(read.at("outputs"));
        result.errors = count_of(read.at("errors"));
        result.warnings = count_of(read.at("warnings"));
        const ordered_json& list = read.at("diagnostics");
        if (!list.is_array()) return std::nullopt;
        for (const ordered_json& one : list) {
            if (!one.is_object()) return std::nullopt;
        }
        result.diagnostics = dumped(list);
        return result;
    } catch (const ordered_json::exception&) {
        return std::nullopt;
    }
}

std::string job_key(const BatchJob& job) {
    // As an array: braces around pairs of words would make an object.
    ordered_json words = ordered_json::array({job.inputs, job.outputs, job.options});
    words.push_back(job.copies ? ordered_json(*job.copies) : ordered_json());
    return sha256(dumped(words)).substr(0, kKeyDigits);
}

std::string command_digest(const std::vector<std::string>& words) {
    std::string text(version());
    for (const std::string& word : words) {
        text += '\0';
        text += word;
    }
    return sha256(text);
}

FileDigest digest_of(const std::string& name, std::string_view bytes) {
    return {name, bytes.size(), sha256(bytes)};
}

FileDigest digest_of(const std::string& name) {
    Diagnostics unheard;
    const std::optional<Source> source = read_source(name, unheard, std::size_t{1} << 40U);
    return source ? digest_of(name, source->text) : FileDigest{name, 0, {}};
}

FileDigest digest_as_read(const std::string& name, std::filesystem::file_time_type begun) {
    FileDigest digest = digest_of(name);
    std::error_code error;
    const auto changed = std::filesystem::last_write_time(name, error);
    return error || changed < begun ? digest : FileDigest{name, 0, {}};
}

bool is_fresh(const JobResult& result, const std::string& command) {
    const bool settled = result.status == JobStatus::done || result.status == JobStatus::failed;
    if (!settled || result.command != command) return false;
    // Sizes first: they are cheap to ask for.
    const auto all = [](const std::vector<FileDigest>& files, auto holds) {
        return std::all_of(files.begin(), files.end(), holds);
    };
    const auto as_large = [](const FileDigest& file) {
        std::error_code error;
        const std::uintmax_t bytes = std::filesystem::file_size(file.file, error);
        return file.sha256.empty() || (!error && bytes == file.bytes);
    };
    const auto same = [](const FileDigest& file) { return digest_of(file.file) == file; };
    return all(result.inputs, as_large) && all(result.outputs, as_large) && all(result.inputs, same) &&
           all(result.outputs, same);
}

std::vector<std::string> oldest_first(std::vector<std::string> names) {
    std::vector<std::pair<std::filesystem::file_time_type, std::string>> timed;
    for (std::string& name : names) {
        std::error_code error;
        timed.emplace_back(std::filesystem::last_write_time(name, error), std::move(name));
    }
    std::stable_sort(timed.begin(), timed.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    names.clear();
    for (auto& [time, name] : timed) names.push_back(std::move(name));
    return names;
}

std::string results_name(const std::string& manifest, int shard, int shards) {
    const auto [directory, stem] = parts_of(manifest);
    if (shards == 1) return directory + stem + ".results.jsonl";
    return fmt::format("{}{}.results.{}-of-{}.jsonl", directory, stem, shard, shards);
}

std::vector<std::string> results_beside(const std::string& manifest) {
    const auto [directory, stem] = parts_of(manifest);
    std::vector<std::string> names;
    std::error_code error;
    for (std::filesystem::directory_iterator at(directory.empty() ? "." : directory, error), end;
         !error && at != end; at.increment(error)) {
        const std::string name = at->path().filename().string();
        const std::string begin = stem + ".results.";
        if (!name.starts_with(begin) || !name.ends_with(".jsonl")) continue;
        // "jsonl" itself, or "2-of-5.jsonl".
        const std::string middle = name.substr(begin.size());
        if (middle != "jsonl" && middle.find("-of-") == std::string::npos) continue;
        names.push_back(directory + name);
    }
    std::sort(names.begin(), names.end());
    return oldest_first(std::move(names));
}

std::optional<ResultIndex::Key> ResultIndex::key_of(std::string_view text) {
    Key key{};
    if (text.size() != kKeyDigits) return std::nullopt;
    for (std::size_t half = 0; half < 2; ++half) {
        const char* begin = text.data() + 16 * half;
        const auto [stop, error] = std::from_chars(begin, begin + 16, key[half], 16);
        if (error != std::errc() || stop != begin + 16) return std::nullopt;
    }
    return key;
}

bool ResultIndex::add(const std::string& name, Diagnostics& diagnostics) {
    std::error_code error;
    if (!std::filesystem::exists(name, error) && !error) return true;
    std::ifstream in(name, std::ios::binary);
    if (!in) {
        diagnostics.error("unreadable-input", {}, name + " cannot be read");
        return false;
    }
    const auto file = static_cast<std::uint32_t>(files_.size());
    files_.push_back(name);
    std::uint64_t offset = 0;
    bool is_results = true;  // no line is another's; one may be cut off
    for (std::string line; std::getline(in, line); offset += line.size() + 1) {
        if (offset == 0) is_results = line.empty() || line.starts_with(kResultBegin.substr(0, line.size()));
        if (!line.starts_with(kResultBegin) || !line.ends_with('}')) continue;
        const std::optional<Key> key = key_of(std::string_view(line).substr(kResultBegin.size(), kKeyDigits));
        if (!key) continue;
        const Spot spot{offset, static_cast<std::uint32_t>(line.size()), file};
        const auto [begin, end] = spots_.equal_range(*key);
        const auto old =
            std::find_if(begin, end, [file](const auto& one) { return one.second.file == file; });
        if (old != end) {
            old->second = spot;
        } else {
            spots_.emplace(*key, spot);
        }
        is_results = true;
    }
    if (is_results) return true;
    diagnostics.error("unreadable-input", {}, name + " holds no results of a batch")
        .hint("name a file that batch has written, such as jobs.results.jsonl");
    return false;
}

std::vector<JobResult> ResultIndex::of(const std::string& key) const {
    std::vector<JobResult> results;
    const std::optional<Key> wanted = key_of(key);
    if (!wanted) return results;
    std::vector<Spot> spots;
    const auto [begin, end] = spots_.equal_range(*wanted);
    for (auto at = begin; at != end; ++at) spots.push_back(at->second);
    std::sort(spots.begin(), spots.end(), [](const Spot& a, const Spot& b) { return a.file < b.file; });
    for (const Spot& spot : spots) {
        std::ifstream in(files_[spot.file], std::ios::binary);
        std::string line(spot.length, '\0');
        in.seekg(static_cast<std::streamoff>(spot.offset));
        if (!in.read(line.data(), static_cast<std::streamsize>(line.size()))) continue;
        std::optional<JobResult> result = result_of(line);
        if (result && result->key == key) results.push_back(std::move(*result));
    }
    return results;
}

}  // namespace popup
