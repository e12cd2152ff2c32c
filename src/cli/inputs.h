// The inputs of a run: read, compiled, and their findings in argument order.
#pragma once

#include <vector>

#include "cli/options.h"
#include "cli/report.h"
#include "popup/compile.h"

namespace popup::cli {

// One run over the inputs of the command line.
struct Run {
    Compilation compilation;              // of the inputs that could be read
    std::vector<Diagnostics> unreadable;  // of those that could not, in argument order
    std::vector<int> order;               // per argument: index into designs, or -1-index into `unreadable`

    // Every argument's findings, in argument order; valid as long as this object.
    [[nodiscard]] std::vector<FileFindings> findings() const;
    [[nodiscard]] bool usable() const { return unreadable.empty(); }
};

// The language a source is read as: --from, else as find_language() finds it; UsageError when there is none.
const Language& language_of(const InputOptions& options, const Source& source);

// Reads and compiles up to `until`. Unreadable inputs do not keep the others from being looked at.
// UsageError on a suffix that names no language and on standard input named twice.
Run run_inputs(const Options& options, Stage until);

}  // namespace popup::cli
