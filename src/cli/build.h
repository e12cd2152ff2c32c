// One build from its options to its files, before anybody is told of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/files/inputs.h"
#include "cli/options/profile_options.h"

namespace popup::cli {

struct Build {
    std::optional<ProfileFile> profile;  // where one is named
    Run run;                             // empty where the profile cannot be used
    std::vector<PendingFile> files;  // all that was written, in the order of writing; empty after an error
    ExitCode status = exit_done;     // of the build; whether its findings can be told is not in it

    // Every file's findings: the profile's where there are any, then the inputs' in argument order. Valid as
    // long as this object.
    [[nodiscard]] std::vector<FileFindings> findings() const;
    // The names of the files that were read, or should have been: the inputs, then the profile, then the
    // configuration and response files, then what programs loaded.
    std::vector<std::string> inputs;
    // The names of files that programs would have loaded from, had they been there.
    std::vector<std::string> missing;
};

// Compiles the inputs and writes all outputs, or none. UsageError when the options do not go together.
Build build(const Options& options);

// The first half of it: reads the profile, into the options, and the inputs, and compiles these. Nothing is
// made of what comes of it, and nothing is written.
Build compile_inputs(Options& options, Stage until);

}  // namespace popup::cli
