// Settings that are not on the command line: those of the environment, and below them those of a popupc.toml.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/options.h"

namespace popup::cli {

// Where the values of options come from that were not given on the command line.
struct Settings {
    std::optional<std::string> file;  // the configuration that was used
    std::map<std::string, std::string>
        origins;  // by the option's key: "POPUPC_SHEET", "designs/popupc.toml:3"
};

// Gives the options of `verb`, which has been parsed, what environment and configuration say, so that they
// read it as if it were on the command line; what was given there stays. An option that stands instead of one
// that was given, or excludes it, is left alone likewise. Appends the configuration that was used to
// `options.settings_files`, and variables that set nothing to `options.unknown_variables`. UsageError for
// everything wrong in the file, for a value that its option does not take, with its place or variable, and
// for inputs that find different configurations.
Settings apply_settings(CLI::App& verb, Options& options);

// The settings of the verb as a popupc.toml, each with where it comes from as a comment; those that are not
// made follow as comments.
std::string render_settings(const CLI::App& verb, const Settings& settings,
                            const std::vector<UnknownVariable>& unknown_variables);

// Whether a file, or none, was asked for by an option or a variable: then no directory is looked into for
// one.
bool is_configuration_chosen(const Options& options);

// "sheet" is "POPUPC_SHEET".
std::string variable_of(std::string_view key);

}  // namespace popup::cli
