// Options that a build was given for nothing.
#pragma once

#include <vector>

#include "cli/options/options.h"
#include "popup/compile.h"
#include "popup/write.h"

namespace popup::cli {

// Remark: `option-unused`, for each option of the command line that only some formats use, if the run
// writes none of these formats; and for each that only some inputs use, if the run has none of these and all
// its inputs could be read. Settings of a configuration or the environment are not reported.
void tell_unused_options(const Options& options, const OutputPlan& plan,
                         const std::vector<CompiledDesign>& designs, Diagnostics& diagnostics);

}  // namespace popup::cli
