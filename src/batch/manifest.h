// The list of a batch's jobs: JSON lines or CSV.
//
// A row says what `popupc build` is asked for: its inputs, its outputs, its options and how many copies. Rows
// stay text, with their places, and are parsed when they are wanted: a million jobs cost what their text
// does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "popup/diagnostics.h"
#include "popup/files.h"

namespace popup {

// Files above this size are refused as manifests: rows have 32 bits for their offsets.
inline constexpr std::size_t kLongestManifest = 0xFFFFFFFFU;

// One build. Names are as the manifest has them.
struct BatchJob {
    std::vector<std::string> inputs;   // at least one, none empty
    std::vector<std::string> outputs;  // likewise
    std::vector<std::string> options;  // words of a command line
    std::optional<int> copies;         // at least 1
};

enum class ManifestForm { json_lines, csv };

class Manifest {
 public:
    [[nodiscard]] std::size_t size() const { return rows_.size(); }
    [[nodiscard]] const std::string& name() const { return source_.name; }
    // The whole text, for excerpts.
    [[nodiscard]] std::string_view text() const { return source_.text; }
    // Parses row `index`.
    [[nodiscard]] BatchJob job(std::size_t index) const;
    // Where row `index` begins.
    [[nodiscard]] Place place(std::size_t index) const { return {static_cast<int>(rows_[index].line), 1}; }
    // The job other than `index` that names this file, or `index` itself where it reads it; nullopt: none
    // does. A relative name counts from the working directory, which is to be that of read_manifest() by now.
    [[nodiscard]] std::optional<std::size_t> taken_by(const std::string& file, std::size_t index) const;
    // The row's text as the manifest has it, without a line break at its end.
    [[nodiscard]] std::string_view text(std::size_t index) const;
    // What stands before the first row and is needed to read the others: the columns of CSV, with a line
    // break.
    [[nodiscard]] std::string_view heading() const;

 private:
    friend std::optional<Manifest> read_manifest(Source source, std::optional<ManifestForm> form,
                                                 Diagnostics& diagnostics, const std::string& directory);
    struct Row {
        std::uint32_t begin = 0, end = 0;  // bytes of the text
        std::uint32_t line = 0;
    };
    Source source_;
    ManifestForm form_ = ManifestForm::json_lines;
    std::vector<Row> rows_;
    std::vector<std::size_t> columns_;  // of CSV: which of the four fields
    std::uint32_t heading_end_ = 0;
    struct Use {
        std::uint64_t file;  // file_number()
        std::uint32_t job;
        bool written;
    };
    std::vector<Use> uses_;  // of all jobs, by file and job

    void check_names(const std::string& directory, Diagnostics& diagnostics);

    bool read_json_lines(Diagnostics& diagnostics);
    bool read_csv(Diagnostics& diagnostics);
    bool read_columns(const std::vector<std::string>& names, Place place, Diagnostics& diagnostics);
};

// A number for a file by its name: the same for "a/./b", "a//b" and "a/c/../b", for the absolute name, and
// for names that reach its directory through links. Others share it only by chance. Relative names count from
// the working directory.
std::uint64_t file_number(const std::string& name);

// Reads every row once; a row that is no job is a `bad-manifest` error at its place, and so are two jobs that
// write the same file and one that reads what another writes, as far as names tell; then nullopt. Without
// `form`, names that end in .csv are CSV and all others JSON lines. Manifests without a job are errors.
//
// JSON lines: an object a line, with `input` (a name or a list of names), `output` (likewise), and, if
// wanted, `options` (a list of words, or one string of words, quoted as in base/quoted_words.h) and
// `copies`. CSV: a first line with the columns' names, the same four; `input` and `output` may be columns
// more than once, empty fields are left out. Empty lines are passed over. Relative names count from
// `directory`; empty: the working directory.
std::optional<Manifest> read_manifest(Source source, std::optional<ManifestForm> form,
                                      Diagnostics& diagnostics, const std::string& directory = {});

}  // namespace popup
