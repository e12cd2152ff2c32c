#pragma once

#include <CLI/CLI.hpp>

#include "popup/output.h"

namespace popup::cli {

// The group "Pictures": --view, --at and --size.
void add_still_options(CLI::App& verb, StillOptions& still);

}  // namespace popup::cli
