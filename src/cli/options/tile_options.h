#pragma once

#include "cli/options/options.h"
#include "popup/write.h"

namespace popup::cli {

// --tile and --tile-margin, in the group "Print".
void add_tile_options(CLI::App& verb, Options& options);

// A UsageError when a margin is given without a paper, when tiles are wanted and there is no .pdf among the
// outputs.
void check_tile_outputs(const Options& options, const OutputPlan& plan);
// A UsageError when tiles do not go together with the other options. Call it once these are all known, those
// of a profile's file too.
void check_tiles(const Options& options);

}  // namespace popup::cli
