// A command line as a verb with its options.
#pragma once

#include <span>
#include <string>
#include <variant>
#include <vector>

#include "cli/options.h"

namespace popup::cli {

// One row a verb: how it is declared to the parser, and what does it. `run` returns the exit code.
struct Verb {
    CLI::App* (*add)(CLI::App&, Options&);
    int (*run)(const Options&);
};
std::span<const Verb> verb_table();

// A verb that was asked for.
struct Command {
    const Verb* verb = nullptr;
    Options options;
};

// Reads the arguments, the program's name not among them. A text is what --help or --version wants printed.
// UsageError when they are wrong.
std::variant<Command, std::string> read_command(std::vector<std::string> arguments);

}  // namespace popup::cli
