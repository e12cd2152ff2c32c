// The record of a gallery: what was made of each design, of what, and which files are the gallery's own.
//
// It is a file of lines of JSON beside the pages. A line is added before the files that it tells of are
// written, and of several lines on one design the last counts: so whenever a run is cut short, its files are
// known as the gallery's, and those of a line whose files were not written are not taken for done.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "batch/results.h"
#include "output/gallery/gallery.h"
#include "popup/diagnostics.h"

namespace popup {

// The record's name in the directory of the gallery.
inline constexpr std::string_view kGalleryRecord = ".popupc-gallery.jsonl";
inline constexpr std::string_view kGalleryIndex = "index.html";
inline constexpr std::string_view kGalleryFolder = "designs";  // where all other files are

struct GalleryRow {
    std::string label;  // as GalleryDesign has it; empty: the page of all designs
    // Of a design, as of a job of a batch. Inputs are named from the library's root, outputs from the
    // gallery's directory; its key and its diagnostics are made from `label` and `findings`.
    JobResult result;
    std::optional<GalleryTile> tile;  // none: there is nothing to show
    std::vector<Diagnostic> findings;
};

// One line with a line break. Equal rows make equal lines; names of files may have any bytes.
std::string to_line(const GalleryRow& row);
// nullopt when it is no such line, or one of a program that knows other diagnostics.
std::optional<GalleryRow> gallery_row_of(std::string_view line);

class GalleryRecord {
 public:
    // Reads the file; one that is not there is empty. False with an `unreadable-input` error: it is there and
    // cannot be read. Lines that are no rows are passed over.
    bool read(const std::string& name, Diagnostics& diagnostics);
    void add(GalleryRow row);
    void remove(const std::string& label);

    // The row of the label, or null.
    [[nodiscard]] const GalleryRow* find(const std::string& label) const;
    [[nodiscard]] const std::map<std::string, GalleryRow>& rows() const { return rows_; }
    // Every file that any line tells of, with the digests of all that was written to it, or was to be.
    [[nodiscard]] const std::map<std::string, std::set<std::string>>& files() const { return own_; }
    // Whether any line tells of the file with these bytes.
    [[nodiscard]] bool has_written(const FileDigest& file) const;

 private:
    std::map<std::string, GalleryRow> rows_;  // by label
    std::map<std::string, std::set<std::string>> own_;
};

}  // namespace popup
