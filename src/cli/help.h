// How help looks, and what is said of an option that is none of ours.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "cli/options/options.h"

namespace popup::cli {

// Sets the formatter, --version, and the examples of the program itself.
void set_up_help(CLI::App& app);

// The help of the verb that was named, or of the program.
std::string help_text(const CLI::App& app);

// The parser's complaint in our words, with the nearest option or verb as a hint.
UsageError explained(const CLI::App& app, const CLI::ParseError& error);

}  // namespace popup::cli
