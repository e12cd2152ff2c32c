#include "cli/gallery/gallery_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <system_error>
#include <utility>

#include "base/system/reason.h"
#include "cli/report.h"

namespace popup::cli {
namespace {

namespace fs = std::filesystem;

bool is_there(const std::string& path) {
    std::error_code error;
    return fs::exists(fs::symlink_status(path, error));
}

[[noreturn]] void refuse(const std::string& given, const std::string& why) {
    throw UsageError(fmt::format("{}: {}", given, why), {"-o names the directory of the gallery"});
}

// The names that a design's files can have.
std::vector<std::string> files_of(const GalleryDesign& design) {
    std::vector<std::string> files;
    for (const std::string_view suffix : {".html", ".jpg", ".png"})
        files.push_back(fmt::format("{}/{}{}", kGalleryFolder, design.name, suffix));
    return files;
}

// The rows in the order of tiles, that of the page first.
std::vector<const GalleryRow*> in_order(const GalleryRecord& record) {
    std::vector<const GalleryRow*> rows;
    for (const auto& [label, row] : record.rows()) rows.push_back(&row);
    std::sort(rows.begin(), rows.end(),
              [](const GalleryRow* a, const GalleryRow* b) { return label_before(a->label, b->label); });
    return rows;
}

}  // namespace

std::string directory_for(const std::string& given, const GalleryPlan& plan) {
    std::error_code error;
    const fs::path path = fs::weakly_canonical(fs::absolute(given, error), error);
    if (error) refuse(given, reason_of(error.value()));
    std::string directory = (path.has_filename() ? path : path.parent_path()).string();
    if (is_there(directory) && !fs::is_directory(directory, error)) refuse(given, "this is no directory");
    for (const GalleryDesign& design : plan.designs) {
        const fs::path below = (fs::path(plan.root) / design.label).lexically_relative(directory);
        if (below.empty() || *below.begin() == "..") continue;
        throw UsageError(
            fmt::format("{} is an input, and lies in {}, where the gallery would be", design.file, given),
            {"a gallery has a directory of its own; it may lie in that of the designs"});
    }
    return directory;
}

GalleryRecord record_of(const std::string& given, const std::string& directory, const GalleryPlan& plan) {
    GalleryRecord record;
    Diagnostics trouble(given + "/" + std::string(kGalleryRecord));
    if (!record.read(directory + "/" + std::string(kGalleryRecord), trouble))
        refuse(trouble.file(), trouble.sorted().front().message);
    std::vector<std::string> files{std::string(kGalleryIndex)};
    for (const GalleryDesign& design : plan.designs) {
        for (std::string& file : files_of(design)) files.push_back(std::move(file));
    }
    for (const std::string& file : files) {
        const bool is_index = file == kGalleryIndex;
        const std::string path = fmt::format("{}/{}", directory, file);
        // Whether others were changed since is looked at when they are written.
        if ((!is_index && record.files().contains(file)) || !is_there(path)) continue;
        FileDigest digest = digest_of(path);
        digest.file = file;
        if (record.has_written(digest)) continue;
        throw UsageError(
            record.files().contains(file)
                ? fmt::format("{}/{} was changed since the gallery was made, and is not overwritten", given,
                              file)
                : fmt::format("{}/{} is there, and no gallery of popupc's has written it", given, file),
            {"move the file away, or name another directory"});
    }
    return record;
}

GalleryFiles::GalleryFiles(std::string given, std::string directory)
    : given_(std::move(given)), directory_(std::move(directory)) {
    std::error_code error;
    fs::create_directories(directory_ + "/" + std::string(kGalleryFolder), error);
    if (error) refuse(given_, reason_of(error.value()));
    if (!lines_.open(directory_ + "/" + std::string(kGalleryRecord), kResultBegin))
        refuse(fmt::format("{}/{}", given_, kGalleryRecord), lines_.trouble());
    remove_litter(directory_);
    remove_litter(directory_ + "/" + std::string(kGalleryFolder));
}

bool GalleryFiles::write(const GalleryRow& row, std::vector<PendingFile> files, const GalleryRecord& record,
                         Diagnostics& diagnostics) {
    bool is_same = true;
    for (PendingFile& file : files) {
        const std::string path = directory_ + "/" + file.path;
        FileDigest there = digest_of(path);
        there.file = file.path;
        const bool is_identical = there == digest_of(file.path, file.bytes);
        is_same = is_same && is_identical;
        if (!is_identical && is_there(path) && !record.has_written(there)) {
            diagnostics
                .error("unwritable-output", {},
                       fmt::format("{}/{} was changed since the gallery was made, and is not overwritten",
                                   given_, file.path))
                .hint("move the file away, then make the gallery again");
            return false;
        }
        file.path = path;
    }
    const GalleryRow* before = record.find(row.label);
    const std::string line = to_line(row);
    if ((before == nullptr || to_line(*before) != line) && !lines_.add(line)) {
        diagnostics.error(
            "unwritable-output", {},
            fmt::format("{}/{} cannot be written: {}", given_, kGalleryRecord, lines_.trouble()));
        return false;
    }
    return is_same || write_all(files, true, diagnostics);
}

std::size_t GalleryFiles::settle(const GalleryRecord& record, const MessageOptions& messages, bool& lost) {
    std::set<std::string> wanted;
    for (const auto& [label, row] : record.rows()) {
        for (const FileDigest& file : row.result.outputs) wanted.insert(file.file);
    }
    std::size_t gone = 0;
    for (const auto& [file, digests] : record.files()) {
        const std::string path = directory_ + "/" + file;
        if (wanted.contains(file) || !is_there(path)) continue;
        if (!digests.contains(digest_of(path).sha256)) {
            announce(messages,
                     fmt::format("{}/{} is no page of the gallery any more, and stays: it was changed",
                                 given_, file));
            continue;
        }
        std::error_code error;
        if (fs::remove(path, error)) ++gone;
    }
    const std::vector<const GalleryRow*> rows = in_order(record);
    auto next = rows.begin();
    lost = !lines_.settle([&]() -> std::optional<std::string> {
        return next == rows.end() ? std::nullopt : std::optional(to_line(**next++));
    });
    return gone;
}

}  // namespace popup::cli
