// The contents of dependency files: which files a run read, and which it wrote.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/options/dependency_options.h"
#include "popup/diagnostics.h"

namespace popup::cli {

// One rule of a makefile, "targets: inputs", folded, with `phony` a second one, "inputs:". Names are written
// so that GNU make 4.3 reads the very same names back, and ninja 1.11 wherever it can; where it cannot, a
// warning (dependency-name) says so. What make cannot hold is an `unwritable-output` error about `file` and
// gives nullopt. Each name is written once; the order is the one given, but that some names cannot come
// first. Precondition: there are targets. Without inputs there is no rule: an empty text.
std::optional<std::string> dependency_rule(const std::vector<std::string>& targets,
                                           const std::vector<std::string>& inputs, bool phony,
                                           const std::string& file, Diagnostics& diagnostics);

// {"inputs": [...], "outputs": [...]}, or null for outputs when there are none. nullopt with an
// `unwritable-output` error where a name is not UTF-8.
std::optional<std::string> dependency_json(const std::vector<std::string>& inputs,
                                           const std::optional<std::vector<std::string>>& outputs,
                                           const std::string& file, Diagnostics& diagnostics);

// Those names that mean files: not standard input, and nothing that exists and is no regular file, such as a
// pipe. Each once.
std::vector<std::string> names_of_files(const std::vector<std::string>& names);

}  // namespace popup::cli
