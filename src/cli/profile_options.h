// What the command line says of lines: the machine profile, and what is wanted other than it has it.
#pragma once

#include "cli/options.h"

namespace popup::cli {

void add_profile_options(CLI::App& verb, Options& options);

// The file of the profile, where one is named, is read into the options. Anything but exit_done: it cannot be
// used, and that was said.
int load_profile(Options& options);

// What is said about lines stands above the profile, wherever it stands. The margin grows to what marks need
// where it was not given. A UsageError when the options do not go together.
void finish_profile(Options& options);

}  // namespace popup::cli
