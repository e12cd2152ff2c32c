// The progress of a run over several designs, on standard error.
#pragma once

#include <cstddef>
#include <functional>

#include "cli/options/options.h"

namespace popup::cli {

// Shows how many designs are done, at what rate, and how long the rest takes: on a terminal a bar that is
// drawn anew at most ten times a second and taken away at the end, elsewhere a line at most once a second,
// and the last. By itself (--progress auto) only for several inputs, on a terminal, and without --quiet. An
// empty function where nothing is to be shown. To be called by one thread at a time; the last call, and no
// other, is for all designs.
std::function<void(std::size_t done, std::size_t total)> progress_meter(const MessageOptions& options,
                                                                        std::size_t inputs);

}  // namespace popup::cli
