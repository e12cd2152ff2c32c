// Options that a build was given for nothing.
#pragma once

#include "cli/options/options.h"
#include "popup/write.h"

namespace popup::cli {

// Remark: `option-unused`, for each option of the command line that only some formats use, if the run
// writes none of these formats. Settings of a configuration or the environment are not reported.
void tell_unused_options(const Options& options, const OutputPlan& plan, Diagnostics& diagnostics);

}  // namespace popup::cli
