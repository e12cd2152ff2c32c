// Reading what is no design: profiles, configurations, manifests, baselines, ignore files.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "popup/diagnostics.h"
#include "popup/files.h"

namespace popup::cli {

// As read_source(), but of devices and pipes it reads none but standard input ("-"): a pipe would keep the
// program waiting, and some devices have no end.
std::optional<Source> read_settings(const std::string& name, Diagnostics& diagnostics,
                                    std::size_t limit_bytes = 64u << 20);

}  // namespace popup::cli
