// The inputs of a run: found, read, compiled, and their findings in argument order.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/options/options.h"
#include "cli/report.h"
#include "popup/compile.h"
#include "popup/write.h"

namespace popup::cli {

// The files that the arguments stand for.
struct InputFiles {
    std::vector<std::string> names;
    // What there is to say of directories, each before the file with this number.
    std::vector<std::pair<std::size_t, Diagnostics>> directories;
    std::vector<std::string> ignore_files;  // that were read in them
    bool readable = true;                   // all directories were
};

// Which files of a directory are taken where nothing is said of it: `documents` are those whose language can
// write them back.
enum class Walked { all, documents };

// The arguments, with the files in directories in place of these: files with the
// suffix of a design's language (of --from, where it is given), or those that --include asks for. No file
// that a walk finds is taken twice, or when it is named itself. A directory without any is a `no-designs`
// warning.
InputFiles find_inputs(const Options& options, Walked walked = Walked::all);

// One run over the inputs of the command line.
struct Run {
    // The findings on an input that is not in the compilation, and its text where it has any.
    struct Apart {
        Diagnostics diagnostics;
        std::string text;
        std::string printed;              // as in CompiledDesign
        std::vector<std::string> loaded;  // likewise: its further files
        bool whole = true;                // as in FileFindings
    };
    InputFiles files;
    Compilation compilation;   // of the inputs that could be read, if everything was to be kept
    BegunFiles begun;          // of its plan; after `compilation`, which it must not outlive
    std::vector<Apart> apart;  // the others
    std::vector<int> order;    // per file: index into designs, or -1-index into `apart`
    bool readable = true;      // every file was

    // Every file's findings, in argument order; valid as long as this object.
    [[nodiscard]] std::vector<FileFindings> findings() const;
    // Any warning or error, on files, directories or the run.
    [[nodiscard]] bool has_findings() const;
    [[nodiscard]] bool usable() const { return readable && files.readable; }
};

// What of a run stays: all values of all designs, or only what was found in them, so that the memory needed
// does not grow with their number. With Keep::findings there is no layout, and what --verbose says of a
// design is said.
enum class Keep { everything, findings };

// The language a source is read as: --from, else as find_language() finds it; UsageError when there is none.
const Language& language_of(const InputOptions& options, const Source& source);

// What a language describes that is no document, in words: "is a program".
std::string_view what_it_is(const Language& language);
// UsageError where a source is known to be no document, with what makes one of it. `takes`: "edit changes
// popup documents".
void check_is_document(const Source& source, const ReadOptions& read, std::string_view takes);

// UsageError where an input has no name or a suffix that names no language, or standard input is named twice.
void check_inputs(const Options& options, const std::vector<std::string>& names);

// Reads the inputs and runs those that are programs; nothing is made of what they draw. The trails are JSON,
// one an input that could be read. UsageError as below, and on an input that is no program.
Run run_trails(const Options& options, std::vector<std::string>& trails);
// The trails of inputs that were compiled; their findings have been told.
std::vector<std::string> trails_of(const Options& options, const Compilation& compilation);

// Reads and compiles up to `until`. Unreadable inputs do not keep the others from being looked at.
// UsageError on a suffix that names no language and on standard input named twice.
// `plan`: of what is to be written; its pages are begun while sheets are laid out.
Run run_inputs(const Options& options, InputFiles files, Stage until, Keep keep = Keep::everything,
               const OutputPlan* plan = nullptr);
// The same, of the arguments as they are: a directory is unreadable.
Run run_inputs(const Options& options, Stage until, const OutputPlan* plan = nullptr);

}  // namespace popup::cli
