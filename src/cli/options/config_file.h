// popupc.toml: where it is, and what it says.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/options/options.h"

namespace popup::cli {

constexpr std::string_view kConfigName = "popupc.toml";

// The popupc.toml that holds for an input: that of its directory (of itself, where it is a directory), else
// of the nearest directory above that has one; nullopt: there is none. An empty name and "-" ask for the
// working directory. The file is named from the working directory, or wholly where the input is.
std::optional<std::string> find_config(const std::string& input);

// All places where it looks for an input, the nearest first.
std::vector<std::string> config_places(const std::string& input);

// True when there is such a file, readable or not.
bool is_config(const std::string& name);

// What a configuration says of one option.
struct ConfigValue {
    std::vector<std::string> texts;  // as the command line would have them; of a flag "true" or "false"
    Place place;                     // of the value
    bool own = false;                // it stands in the verb's own table
};

struct ConfigFile {
    std::string name;
    std::string text;
    // What holds for the verb, by the options' keys: its own table's values above those of the top.
    std::map<std::string, ConfigValue> values;
};

// Reads the file for `verb`, which is one of `app`. Names of files in it count from its directory. Everything
// that is wrong in it, also what is meant for other verbs, becomes one UsageError: keys that are no option's
// or belong to one run, values of the wrong kind. Whether a value is any good is known when its option reads
// it.
ConfigFile read_config(const std::string& name, const CLI::App& app, const CLI::App& verb);

// True when any option of the verb can be configured.
bool is_configurable(const CLI::App& verb);

}  // namespace popup::cli
