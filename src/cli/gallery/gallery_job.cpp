#include "cli/gallery/gallery_job.h"

#include <fmt/format.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <optional>
#include <utility>

namespace popup::cli {
namespace {

// What the design's source is called in the library's root. "-" alone would be standard input.
std::string source_name(const GalleryDesign& design) { return design.label == "-" ? "./-" : design.label; }

// The row with its outputs named from anywhere.
JobResult placed(const GalleryRun& run, JobResult result) {
    for (FileDigest& file : result.outputs) file.file.insert(0, run.directory + "/");
    return result;
}

// What follows a number of bytes and a line break, taken off the front.
std::string_view take(std::string_view& bytes) {
    const std::size_t end = bytes.find('\n');
    POPUP_INVARIANT(end != std::string_view::npos);
    const std::size_t size = std::stoull(std::string(bytes.substr(0, end)));
    const std::string_view text = bytes.substr(end + 1, size);
    POPUP_INVARIANT(text.size() == size);
    bytes.remove_prefix(end + 1 + size);
    return text;
}

void put(std::string& bytes, std::string_view text) {
    bytes += fmt::format("{}\n", text.size());
    bytes += text;
}

}  // namespace

GalleryReply make_one(const GalleryRun& run, std::size_t index) {
    const GalleryDesign& design = run.plan.designs[index];
    const GalleryRow* known = run.record.find(design.label);
    if (known != nullptr && is_fresh(placed(run, known->result), run.command)) return {};
    if (run.dry_run) return {GalleryNews::due, {}};
    const std::string name = source_name(design);
    Diagnostics trouble(name, run.policy);
    std::optional<Source> source = read_source(name, trouble);
    if (!source) return {GalleryNews::made, failed_entry(design, JobStatus::unusable, trouble)};
    std::vector<FileDigest> inputs{digest_of(name, source->text)};
    const auto begun = std::filesystem::file_time_type::clock::now();
    GalleryReply reply{GalleryNews::made, make_entry(design, std::move(*source), run.compile, run.policy)};
    for (const std::string& file : reply.entry.further_files) inputs.push_back(digest_as_read(file, begun));
    for (const std::string& file : reply.entry.missing_files) inputs.push_back({file, 0, {}});
    reply.entry.row.result.inputs = std::move(inputs);
    reply.entry.row.result.command = run.command;
    return reply;
}

GalleryReply crashed_one(const GalleryRun& run, std::size_t index, int signal) {
    const GalleryDesign& design = run.plan.designs[index];
    Diagnostics findings(source_name(design), run.policy);
    findings
        .error("job-crashed", {},
               fmt::format("the process that looked at this died twice{}",
                           signal == 0 ? std::string()
                                       : fmt::format(", by signal {} ({})", signal, ::strsignal(signal))))
        .hint(signal == SIGKILL ? "the system may have run out of memory: try fewer processes with -j"
                                : "please report it with this input; the other designs went on");
    return {GalleryNews::made, failed_entry(design, JobStatus::crashed, findings)};
}

std::string packed(const GalleryReply& reply) {
    std::string bytes(1, static_cast<char>(reply.news));
    if (reply.news != GalleryNews::made) return bytes;
    put(bytes, to_line(reply.entry.row));
    put(bytes, reply.entry.printed);
    for (const PendingFile& file : reply.entry.files) {
        put(bytes, file.path);
        put(bytes, file.bytes);
    }
    return bytes;
}

GalleryReply unpacked_reply(const std::string& bytes) {
    POPUP_INVARIANT(!bytes.empty());
    GalleryReply reply{static_cast<GalleryNews>(bytes.front()), {}};
    if (reply.news != GalleryNews::made) return reply;
    std::string_view rest = std::string_view(bytes).substr(1);
    std::optional<GalleryRow> row = gallery_row_of(take(rest));
    POPUP_INVARIANT(row.has_value());
    reply.entry.row = std::move(*row);
    reply.entry.printed = take(rest);
    while (!rest.empty()) {
        const std::string_view path = take(rest);
        reply.entry.files.push_back({std::string(path), std::string(take(rest))});
    }
    return reply;
}

}  // namespace popup::cli
