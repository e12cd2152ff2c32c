#pragma once

#include "cli/options/options.h"
#include "popup/write.h"

namespace popup::cli {

// --tile and --tile-margin, in the group "Print".
void add_tile_options(CLI::App& verb, Options& options);

// Gives tiles the margin that was asked for. A UsageError when there is a margin and no paper, when no output
// is a .pdf, and when tiles do not go together with the other options. Call it once these are all known,
// those of a profile's file too.
void finish_tiles(Options& options, const OutputPlan& plan);

}  // namespace popup::cli
