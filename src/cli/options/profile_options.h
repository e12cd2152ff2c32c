// What the command line says of lines: the machine profile, and what is wanted other than it has it.
#pragma once

#include <optional>

#include "cli/options/options.h"
#include "popup/files.h"

namespace popup::cli {

void add_profile_options(CLI::App& verb, Options& options);

// A profile's file as it was read.
struct ProfileFile {
    Diagnostics diagnostics;
    Source source;  // without text where it could not be read
    bool readable = true;
};

// Reads the profile's file, where one is named, into the options; where its findings have errors it cannot be
// used, and the options are as they were.
std::optional<ProfileFile> load_profile(Options& options);

// What is said about lines stands above the profile, wherever it stands. The margin grows to what marks need
// where it was not given. A UsageError when the options do not go together.
void finish_profile(Options& options);

}  // namespace popup::cli
