// The directory of a gallery: which of its files may be written, and how they are.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "batch/kept_lines.h"
#include "cli/gallery/gallery_job.h"

namespace popup::cli {

// The gallery's directory, absolute and with links followed, whether it is there or not. UsageError when it
// is a file, or when a design lies in it.
std::string directory_for(const std::string& given, const GalleryPlan& plan);

// Reads what earlier runs wrote down. UsageError when it cannot be read, and when a file that this run would
// write is there and is not the gallery's.
GalleryRecord record_of(const std::string& given, const std::string& directory, const GalleryPlan& plan);

// A gallery that is written to. One process at a time has it. `given` is its directory as messages name it.
class GalleryFiles {
 public:
    // Makes the directories, takes away what killed runs left, and opens the record. UsageError when that
    // cannot be done.
    GalleryFiles(std::string given, std::string directory);

    // Writes the row down, then its files: all or none. False with an `unwritable-output` error when they
    // cannot be written, or when one is there that the gallery did not write; then nothing has changed but
    // that the record knows of the files.
    bool write(const GalleryRow& row, std::vector<PendingFile> files, const GalleryRecord& record,
               Diagnostics& diagnostics);
    // Takes away the files that the record knows of and no row of it has any more, and leaves the rows in the
    // record's file: that of the page first, then the others in the order of tiles. Files that somebody
    // has changed stay, and are told. Returns how many are gone. `lost`: the record cannot be written.
    std::size_t settle(const GalleryRecord& record, const MessageOptions& messages, bool& lost);
    void close() { lines_.close(); }
    [[nodiscard]] const std::string& trouble() const { return lines_.trouble(); }

 private:
    std::string given_;
    std::string directory_;
    KeptLines lines_;
};

}  // namespace popup::cli
