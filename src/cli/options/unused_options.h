// Options that a build was given for nothing.
#pragma once

#include "cli/options/options.h"
#include "popup/write.h"

namespace popup::cli {

// Remark: `option-unused`, for each option of the command line that only some formats regard, when the run
// writes none of these. What a configuration or the environment sets for every run is not asked.
void tell_unused_options(const Options& options, const OutputPlan& plan, Diagnostics& diagnostics);

}  // namespace popup::cli
