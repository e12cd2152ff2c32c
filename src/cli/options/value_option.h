// Options that take a value, and values out of closed lists: what the groups of options have in common.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cli/options/options.h"

namespace popup::cli {

// The value that `text` names, out of a closed list; else a UsageError that gives the list.
template <typename Value>
Value choose(std::string_view option, std::string_view text,
             std::initializer_list<std::pair<std::string_view, Value>> choices) {
    std::vector<std::string_view> names;
    for (const auto& [name, value] : choices) {
        if (name == text) return value;
        names.push_back(name);
    }
    throw UsageError(fmt::format("{} takes {}, not \"{}\"", option, fmt::join(names, ", "), text),
                     did_you_mean(text, names), names);
}

// Has `use` read the text that the option was given. A UsageError of it says of which option it is.
template <typename Use>
void use_value(const std::string& names, const std::string& text, const Use& use) {
    try {
        use(std::string_view(text));
    } catch (UsageError& error) {
        error.blame(names, text);
        throw;
    }
}

// A value option whose text `use` reads. The text given last counts.
template <typename Use>
CLI::Option* value(CLI::App& verb, const std::string& names, const std::string& type,
                   const std::string& about, const std::string& group, Use use) {
    return verb
        .add_option_function<std::string>(
            names, [names, use](const std::string& text) { use_value(names, text, use); }, about)
        ->type_name(type)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast)
        ->group(group);
}

// The same, repeatable: `use` reads each text in turn.
template <typename Use>
CLI::Option* values(CLI::App& verb, const std::string& names, const std::string& type,
                    const std::string& about, const std::string& group, Use use) {
    return verb
        .add_option_function<std::vector<std::string>>(
            names,
            [names, use](const std::vector<std::string>& texts) {
                for (const std::string& text : texts) use_value(names, text, use);
            },
            about)
        ->type_name(type)
        ->allow_extra_args(false)
        ->group(group);
}

// What configurations and completions want to know of an option beside what the parser tells.
struct OptionTraits {
    std::string key;          // its long name without the dashes; of a positional its name
    bool flag = false;        // takes no value
    bool repeatable = false;  // takes several values
    bool files = false;       // every value is the name of a file or directory
    std::string suffix;       // a value that ends in this is the name of a file; empty: none is
    std::string instead_of;   // key of the option that this one stands instead of; empty: none
};
OptionTraits traits_of(const CLI::Option& option);

}  // namespace popup::cli
