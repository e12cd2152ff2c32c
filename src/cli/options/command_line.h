// A command line as a verb with its options.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "cli/options/options.h"

namespace popup::cli {

// One row a verb: its name, how it is declared to the parser, and what does it. `run` returns the exit code.
struct Verb {
    std::string_view name;
    CLI::App* (*add)(CLI::App&, Options&);
    int (*run)(const Options&);
};
std::span<const Verb> verb_table();

// A verb that was asked for.
struct Command {
    const Verb* verb = nullptr;
    Options options;
};

// The program as the parser knows it, with these verbs in their order and all their options, which write into
// `options`; these must outlive it.
std::unique_ptr<CLI::App> declare_program(Options& options, std::span<const Verb> verbs);

// Reads the arguments, the program's name not among them: response files in them, the options they give, and
// for what they do not give the environment (POPUPC_*) and the popupc.toml of the inputs. A text is what
// --help,
// --version or --print-config wants printed. UsageError when anything of this is wrong.
std::variant<Command, std::string> read_command(std::vector<std::string> arguments);

}  // namespace popup::cli
