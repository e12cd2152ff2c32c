#include "cli/options/config.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <system_error>
#include <utility>

#include "base/text/nearest.h"
#include "cli/options/command_line.h"
#include "cli/options/config_file.h"
#include "cli/options/dependency_options.h"
#include "cli/options/value_option.h"

namespace popup::cli {
namespace {

constexpr std::string_view kPrefix = "POPUPC_";

// An empty variable is one that is not set.
std::optional<std::string> variable(const std::string& name) {
    const char* text = std::getenv(name.c_str());
    if (text == nullptr || *text == '\0') return std::nullopt;
    return text;
}

std::string flag_value(const std::string& name, const std::string& text) {
    if (text == "1" || text == "true") return "true";
    if (text == "0" || text == "false") return "false";
    throw UsageError(fmt::format("{} takes 1, 0, true or false, not \"{}\"", name, text));
}

std::vector<std::string> variable_values(const std::string& name, const std::string& text,
                                         const OptionTraits& traits) {
    if (traits.flag) return {flag_value(name, text)};
    if (!traits.repeatable) return {text};
    std::vector<std::string> values;
    for (std::size_t at = 0; at <= text.size();) {
        const std::size_t comma = std::min(text.find(',', at), text.size());
        if (comma > at) values.push_back(text.substr(at, comma - at));
        at = comma + 1;
    }
    return values;
}

std::string directory_of(const std::string& input) {
    const std::size_t slash = input.rfind('/');
    return slash == std::string::npos ? std::string() : input.substr(0, std::max<std::size_t>(slash, 1));
}

std::string named(const std::optional<std::string>& file) { return file ? *file : "no popupc.toml"; }

// What an option or a variable says of the configuration.
struct Choice {
    bool made = false;
    std::optional<std::string> file;  // none: no configuration
};
Choice choice_of(const Options& options) {
    const ConfigOptions& given = options.config;
    if (given.off) return {true, std::nullopt};
    if (!given.file.empty()) return {true, given.file};
    if (auto file = variable(variable_of("config"))) return {true, std::move(file)};
    const std::string off = variable_of("no-config");
    const auto text = variable(off);
    return {text && flag_value(off, *text) == "true", std::nullopt};
}

// The configuration of the run: one for all inputs, or none.
std::optional<std::string> config_of(const Options& options) {
    if (Choice choice = choice_of(options); choice.made) return std::move(choice.file);
    const std::vector<std::string>& inputs = options.inputs.names;
    if (inputs.empty()) return find_config({});
    std::optional<std::string> first = find_config(inputs.front());
    std::set<std::string> seen;  // directories of files that were looked up
    for (const std::string& input : inputs) {
        std::error_code error;
        const bool is_directory = std::filesystem::is_directory(input, error);
        if (!is_directory && !seen.insert(directory_of(input)).second) continue;
        const std::optional<std::string> other = find_config(input);
        if (first == other || (first && other && std::filesystem::equivalent(*first, *other, error)))
            continue;
        throw UsageError(fmt::format("one run has one configuration: {} has {}, and {} has {}",
                                     inputs.front(), named(first), input, named(other)),
                         {"--config FILE names one for all, --no-config takes none", "or run them apart"});
    }
    return first;
}

// One level's way of giving an option its values.
class Level {
 public:
    Level(CLI::App& verb, Settings& settings) : verb_(verb), settings_(settings) {
        for (const CLI::Option* option : verb.get_options()) {
            if (option->count() > 0 && !is_off(*option)) above_.insert(option);
        }
    }

    void set(CLI::Option& option, const OptionTraits& traits, const std::vector<std::string>& values,
             const std::string& origin) {
        const bool off = traits.flag && values.front() == "false";
        if (values.empty() || !is_open(option, traits, off)) return;
        for (const std::string& value : values) option.add_result(value);
        option.run_callback();
        settings_.origins[traits.key] = origin;
    }

 private:
    // False where the option was set above, or one that excludes it or stands instead of it. UsageError when
    // this level has set one that excludes it.
    [[nodiscard]] bool is_open(const CLI::Option& option, const OptionTraits& traits, bool off) const {
        if (option.count() > 0) return false;
        if (off) return true;
        for (const CLI::Option* other : option.get_excludes()) {
            if (above_.contains(other)) return false;
            if (other->count() == 0 || is_off(*other)) continue;
            throw UsageError(
                fmt::format("\"{}\" and \"{}\" exclude each other", traits_of(*other).key, traits.key));
        }
        if (!traits.instead_of.empty()) {
            const CLI::Option* other = verb_.get_option_no_throw("--" + traits.instead_of);
            if (other != nullptr && above_.contains(other)) return false;
        }
        return true;
    }

    static bool is_off(const CLI::Option& flag) {
        return flag.get_items_expected_max() == 0 && !flag.results().empty() &&
               flag.results().back() == "false";
    }

    CLI::App& verb_;
    Settings& settings_;
    std::set<const CLI::Option*> above_;  // given by a higher level
};

std::vector<std::pair<CLI::Option*, OptionTraits>> settable(CLI::App& verb) {
    std::vector<std::pair<CLI::Option*, OptionTraits>> options;
    for (CLI::Option* option : verb.get_options()) {
        if (option->get_configurable() && option->nonpositional())
            options.emplace_back(option, traits_of(*option));
    }
    return options;
}

void apply_environment(CLI::App& verb, Settings& settings) {
    Level level(verb, settings);
    for (const auto& [option, traits] : settable(verb)) {
        const std::string name = variable_of(traits.key);
        const std::optional<std::string> text = variable(name);
        if (!text) continue;
        try {
            level.set(*option, traits, variable_values(name, *text, traits), name);
        } catch (const UsageError& error) {
            const std::string what = error.what();
            throw UsageError(what.starts_with(name) ? what : fmt::format("{}: {}", name, what),
                             error.hints());
        } catch (const CLI::ParseError& error) {
            throw UsageError(fmt::format("{}: {}", name, error.what()));
        }
    }
}

// Those values that stand in the verb's own table, or those that do not.
void apply_values(const ConfigFile& file, bool own, CLI::App& verb, Level& level, Diagnostics& trouble) {
    for (const auto& [option, traits] : settable(verb)) {
        const auto found = file.values.find(traits.key);
        if (found == file.values.end() || found->second.own != own) continue;
        const ConfigValue& value = found->second;
        try {
            level.set(*option, traits, value.texts, fmt::format("{}:{}", file.name, value.place.line));
        } catch (const UsageError& error) {
            Diagnostic& wrong = trouble.error("bad-config", value.place, error.what());
            for (const std::string& hint : error.hints()) wrong.hint(hint);
        } catch (const CLI::ParseError& error) {
            trouble.error("bad-config", value.place, error.what());
        }
    }
}

// Whether the verb's own table has an option about the sheet whose value is that of a variable.
bool asks_for_sheets(const ConfigFile& file, CLI::App& verb, const Settings& settings) {
    Options probe;
    std::unique_ptr<CLI::App> program;
    for (const auto& [option, traits] : settable(verb)) {
        const auto found = file.values.find(traits.key);
        if (found == file.values.end() || !found->second.own) continue;
        const auto origin = settings.origins.find(traits.key);
        if (origin == settings.origins.end() || !origin->second.starts_with(kPrefix)) continue;
        if (!program) program = declare_program(probe, verb_table());
        CLI::Option* same = program->get_subcommand(verb.get_name())->get_option_no_throw(option->get_name());
        if (same == nullptr || found->second.texts.empty()) continue;
        for (const std::string& text : found->second.texts) same->add_result(text);
        try {
            same->run_callback();
        } catch (const std::exception&) {
            continue;  // it is told where the value is used
        }
    }
    return probe.sheet_given;
}

// Variables that look like ours and set no option of any verb, by name.
std::vector<UnknownVariable> unknown_variables() {
    std::set<std::string> names;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string_view text = *entry;
        const std::string_view name = text.substr(0, text.find('='));
        if (name.starts_with(kPrefix)) names.emplace(name);
    }
    if (names.empty()) return {};
    std::set<std::string> known{variable_of("config"), variable_of("no-config")};
    std::map<std::string, std::string> of_one_run;  // what is not set by variables, as it is given
    Options scratch;
    const std::unique_ptr<CLI::App> program = declare_program(scratch, verb_table());
    for (CLI::App* verb : program->get_subcommands([](const CLI::App*) { return true; })) {
        for (const auto& [option, traits] : settable(*verb)) known.insert(variable_of(traits.key));
        for (const CLI::Option* option : verb->get_options()) {
            if (!option->nonpositional()) continue;
            const std::string key = traits_of(*option).key;
            of_one_run.emplace(variable_of(key), shown_option(key));
        }
    }
    std::vector<std::string_view> choices;  // and the names, without what all begin with
    choices.reserve(known.size());
    for (const std::string& name : known) choices.push_back(std::string_view(name).substr(kPrefix.size()));
    std::vector<UnknownVariable> unknown;
    for (const std::string& name : names) {
        if (known.contains(name)) continue;
        std::string why = "sets no option";
        const std::vector<std::string> meant =
            nearest(std::string_view(name).substr(kPrefix.size()), choices, 1);
        if (const auto option = of_one_run.find(name); option != of_one_run.end()) {
            why = fmt::format("sets nothing: {} belongs to one run, and is given on the command line",
                              option->second);
        } else if (!meant.empty()) {
            why += fmt::format("; did you mean {}{}?", kPrefix, meant.front());
        }
        unknown.push_back({name, std::move(why)});
    }
    return unknown;
}

std::string toml_string(std::string_view text) {
    std::string quoted = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') {
            quoted += fmt::format("\\{}", c);
        } else if (byte < 0x20 || byte == 0x7f) {
            quoted += fmt::format("\\u{:04X}", byte);
        } else {
            quoted += c;
        }
    }
    return quoted + "\"";
}

std::string toml_value(const CLI::Option& option, const OptionTraits& traits) {
    const std::vector<std::string>& results = option.results();
    if (traits.flag) return results.back();
    if (!traits.repeatable) return toml_string(results.back());
    std::string text;
    for (const std::string& one : results) text += (text.empty() ? "" : ", ") + toml_string(one);
    return "[" + text + "]";
}

std::string with_comment(std::string left, const std::string& comment) {
    constexpr std::size_t kColumn = 32;
    if (left.size() < kColumn) left.resize(kColumn, ' ');
    return left + "  # " + comment + "\n";
}

}  // namespace

bool is_configuration_chosen(const Options& options) { return choice_of(options).made; }

std::string variable_of(std::string_view key) {
    std::string name(kPrefix);
    for (const char c : key) {
        name += c == '-' ? '_' : c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    }
    return name;
}

Settings apply_settings(CLI::App& verb, Options& options) {
    Settings settings;
    if (!is_configurable(verb)) return settings;
    // What is said of the sheet for every run, whatever its verb, does not ask a check to lay anything out.
    const bool sheet_given = options.sheet_given;
    // How many threads are right in general does not say that make is not to be asked.
    const bool jobs_given = options.jobs_given;
    apply_environment(verb, settings);
    options.sheet_given = sheet_given;
    settings.file = config_of(options);
    if (settings.file) {
        options.settings_files.push_back(*settings.file);
        // It speaks of all verbs, not only of this one.
        Options scratch;
        const std::unique_ptr<CLI::App> program = declare_program(scratch, verb_table());
        const ConfigFile file =
            read_config(*settings.file, *program, *program->get_subcommand(verb.get_name()));
        Diagnostics trouble(file.name);
        // The verb's own table stands above the rest of the file.
        Level own(verb, settings);
        apply_values(file, true, verb, own, trouble);
        const bool own_sheet = options.sheet_given || asks_for_sheets(file, verb, settings);
        Level rest(verb, settings);
        apply_values(file, false, verb, rest, trouble);
        options.sheet_given = own_sheet;
        if (trouble.has_errors()) throw UsageError(trouble, file.text);
    }
    options.jobs_given = jobs_given;
    options.unknown_variables = unknown_variables();
    return settings;
}

std::string render_settings(const CLI::App& verb, const Settings& settings,
                            const std::vector<UnknownVariable>& unknown_variables) {
    std::string text = fmt::format(
        "# popupc {}: {}\n", verb.get_name(),
        settings.file ? "settings with " + *settings.file : std::string("settings; there is no popupc.toml"));
    for (const UnknownVariable& one : unknown_variables) text += fmt::format("# {} {}\n", one.name, one.why);
    std::string unset;
    for (const CLI::Option* option : verb.get_options()) {
        if (!option->get_configurable() || !option->nonpositional()) continue;
        const OptionTraits traits = traits_of(*option);
        if (option->count() == 0) {
            const std::string type = option->get_type_name();
            const std::string value = traits.flag         ? "true"
                                      : traits.repeatable ? fmt::format("[\"{}\"]", type)
                                                          : fmt::format("\"{}\"", type);
            unset += with_comment(fmt::format("# {} = {}", traits.key, value), option->get_description());
            continue;
        }
        const auto origin = settings.origins.find(traits.key);
        text += with_comment(fmt::format("{} = {}", traits.key, toml_value(*option, traits)),
                             origin == settings.origins.end() ? "--" + traits.key : origin->second);
    }
    if (!unset.empty()) text += "\n# Not set:\n" + unset;
    return text;
}

}  // namespace popup::cli
