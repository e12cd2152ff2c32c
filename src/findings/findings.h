// The findings of a run as they are told: which are new, which a baseline accepts, and how many there are.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "popup/diagnostics.h"

namespace popup {

// The findings on one input, and its text for the excerpts (empty where it could not be read).
struct FileFindings {
    const Diagnostics* diagnostics = nullptr;
    std::string_view text;
    bool design = true;  // false: a file that designs are made with, such as a profile
    bool whole = true;   // false: an error kept later stages from looking for more
};

// One file and what is said of it.
struct ToldFile {
    std::string name;
    std::string_view text;
    bool design = true;
    std::vector<Diagnostic> told;      // worst first, then by place
    std::vector<Diagnostic> accepted;  // those that a baseline accepts, in the same order
    bool whole = true;                 // as in FileFindings
};

// All that one run has to say.
struct Findings {
    std::vector<ToldFile> files;  // in the order of the arguments
    // What concerns the run as a whole. A finding that names a file here was found where all files are looked
    // at together, on the sheets.
    std::vector<Diagnostic> run;
    std::vector<Diagnostic> run_accepted;
    bool compared = false;  // with a baseline

    [[nodiscard]] std::size_t designs() const;
    // True when anything that is told is a warning or an error.
    [[nodiscard]] bool fail() const;
    [[nodiscard]] std::size_t accepted() const;
};

// The findings as they were collected. The texts must outlive the result.
Findings collect(const std::vector<FileFindings>& files, const Diagnostics& run);

// The same without remarks, but for those that stand for warnings and errors that were only counted.
Findings without_remarks(Findings findings);

}  // namespace popup
