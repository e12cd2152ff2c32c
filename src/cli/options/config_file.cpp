#include "cli/options/config_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <system_error>
#include <utility>

#include "base/text/nearest.h"
#include "base/text/toml_text.h"
#include "cli/files/read_settings.h"
#include "cli/options/value_option.h"
#include "popup/files.h"

namespace popup::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kCode = "bad-config";

std::vector<const CLI::App*> verbs_of(const CLI::App& app) {
    return app.get_subcommands([](const CLI::App* verb) { return is_configurable(*verb); });
}

// Positionals are what a run is about, and no settings of it.
bool can_be_set(const CLI::Option& option) { return option.get_configurable() && option.nonpositional(); }

const CLI::Option* option_of(const CLI::App& verb, std::string_view key) {
    for (const CLI::Option* option : verb.get_options()) {
        const std::vector<std::string>& names = option->get_lnames();
        if (option->nonpositional() && std::find(names.begin(), names.end(), key) != names.end())
            return option;
    }
    return nullptr;
}

class Reader {
 public:
    Reader(ConfigFile& file, const CLI::App& app, const CLI::App& verb, Diagnostics& trouble)
        : file_(file), app_(app), verb_(verb), trouble_(trouble) {}

    void read(const toml::table& top) {
        for (const auto& [key, node] : top) {
            if (const CLI::App* verb = verb_named(key.str())) {
                if (const toml::table* table = node.as_table()) {
                    read_table(*table, *verb);
                } else {
                    std::string what = fmt::format("\"{}\" is a verb: its options stand in a table [{}]",
                                                   key.str(), key.str());
                    const std::string option = fmt::format("--{}", key.str());
                    for (const CLI::App* other : app_.get_subcommands({})) {
                        if (other->get_option_no_throw(option) == nullptr) continue;
                        what += fmt::format(", and the option {} of {} in [{}]", option, other->get_name(),
                                            other->get_name());
                        break;
                    }
                    wrong(node.source(), what);
                }
            } else {
                read_top(key, node);
            }
        }
        // What a verb's own table says counts more, wherever it stands.
        for (auto& [key, value] : own_) file_.values.insert_or_assign(key, std::move(value));
    }

 private:
    Diagnostic& wrong(const toml::source_region& region, std::string message) {
        return trouble_.error(kCode, place_of(region), std::move(message));
    }

    [[nodiscard]] const CLI::App* verb_named(std::string_view name) const {
        for (const CLI::App* verb : verbs_of(app_)) {
            if (verb->get_name() == name) return verb;
        }
        return nullptr;
    }

    void read_table(const toml::table& table, const CLI::App& verb) {
        for (const auto& [key, node] : table) {
            const CLI::Option* option = option_of(verb, key.str());
            if (option == nullptr || !can_be_set(*option)) {
                refuse(key, option, &verb);
                continue;
            }
            std::optional<ConfigValue> value = value_of(key.str(), node, *option);
            if (!value || &verb != &verb_) continue;
            value->own = true;
            own_.insert_or_assign(std::string(key.str()), std::move(*value));
        }
    }

    // A key at the top, for every verb that has the option.
    void read_top(const toml::key& key, const toml::node& node) {
        const CLI::Option* known = nullptr;
        const CLI::Option* usable = nullptr;
        for (const CLI::App* verb : verbs_of(app_)) {
            const CLI::Option* option = option_of(*verb, key.str());
            if (option == nullptr) continue;
            known = option;
            if (!can_be_set(*option)) continue;
            if (usable == nullptr || verb == &verb_) usable = option;
        }
        if (usable == nullptr) {
            refuse(key, known, nullptr);
            return;
        }
        std::optional<ConfigValue> value = value_of(key.str(), node, *usable);
        if (!value) return;
        const CLI::Option* own = option_of(verb_, key.str());
        if (own != nullptr && can_be_set(*own)) {
            file_.values.insert_or_assign(std::string(key.str()), std::move(*value));
        }
    }

    // `option` is the one that has the name but cannot be configured; null where none has it. `table` is the
    // verb in whose table the key stands, null at the top.
    void refuse(const toml::key& key, const CLI::Option* option, const CLI::App* table) {
        if (option != nullptr) {
            wrong(key.source(), fmt::format("\"{}\" belongs to one run and cannot be configured", key.str()))
                .hint(fmt::format("give --{} on the command line", key.str()));
            return;
        }
        std::vector<std::string> known;
        std::string others;
        for (const CLI::App* verb : verbs_of(app_)) {
            if (table == nullptr) known.push_back(verb->get_name());
            if (table != nullptr && table != verb) {
                const CLI::Option* other = option_of(*verb, key.str());
                if (other != nullptr && can_be_set(*other))
                    others += fmt::format("{}{}", others.empty() ? "" : ", ", verb->get_name());
                continue;
            }
            for (const CLI::Option* one : verb->get_options()) {
                if (can_be_set(*one)) known.push_back(traits_of(*one).key);
            }
        }
        const std::string where = table == nullptr ? std::string() : fmt::format(" of {}", table->get_name());
        Diagnostic& unknown =
            wrong(key.source(), fmt::format("there is no option \"{}\"{}", key.str(), where));
        if (!others.empty()) {
            unknown.hint(fmt::format("it is an option of {}", others));
            return;
        }
        const std::vector<std::string_view> names(known.begin(), known.end());
        const std::vector<std::string> meant = nearest(key.str(), names, 1);
        unknown.hint(meant.empty()
                         ? fmt::format("keys are the long names of options: see \"popupc {} --help\"",
                                       table == nullptr ? "build" : table->get_name())
                         : fmt::format("did you mean \"{}\"?", meant.front()));
    }

    std::optional<ConfigValue> value_of(std::string_view key, const toml::node& node,
                                        const CLI::Option& option) {
        const OptionTraits traits = traits_of(option);
        ConfigValue value{{}, place_of(node.source())};
        const auto refuse_kind = [&](const toml::node& given, std::string_view wanted) {
            wrong(given.source(), fmt::format("\"{}\" takes {}, not {}", key, wanted, kind_of(given)));
            return std::nullopt;
        };
        if (traits.flag) {
            const auto* flag = node.as_boolean();
            if (flag == nullptr) return refuse_kind(node, "true or false");
            value.texts.emplace_back(flag->get() ? "true" : "false");
            return value;
        }
        const toml::array* list = node.as_array();
        if (list != nullptr && !traits.repeatable) return refuse_kind(node, "a string or a number");
        if (list == nullptr) {
            std::optional<std::string> text = text_of(node, traits);
            if (!text) {
                return refuse_kind(node, traits.repeatable ? "a list of strings" : "a string or a number");
            }
            value.texts.push_back(std::move(*text));
            return value;
        }
        for (const toml::node& one : *list) {
            std::optional<std::string> text = text_of(one, traits);
            if (!text) return refuse_kind(one, "a list of strings");
            value.texts.push_back(std::move(*text));
        }
        return value;
    }

    [[nodiscard]] std::optional<std::string> text_of(const toml::node& node,
                                                     const OptionTraits& traits) const {
        if (const auto* number = node.as_integer()) return fmt::format("{}", number->get());
        if (const auto* number = node.as_floating_point()) return fmt::format("{}", number->get());
        const auto* given = node.as_string();
        if (given == nullptr) return std::nullopt;
        std::string text = given->get();
        const bool is_file = traits.files || (!traits.suffix.empty() && text.ends_with(traits.suffix));
        if (!is_file || text.empty() || text == "-" || text.starts_with('/')) return text;
        return (fs::path(file_.name).parent_path() / text).string();
    }

    ConfigFile& file_;
    const CLI::App& app_;
    const CLI::App& verb_;
    Diagnostics& trouble_;
    std::map<std::string, ConfigValue> own_;  // of the verb's table
};

}  // namespace

bool is_configurable(const CLI::App& verb) {
    const std::vector<const CLI::Option*> options = verb.get_options();
    return std::any_of(options.begin(), options.end(),
                       [](const CLI::Option* option) { return can_be_set(*option); });
}

std::vector<std::string> config_places(const std::string& input) {
    std::vector<std::string> places;
    std::error_code error;
    const fs::path here = fs::current_path(error);
    if (error) return places;
    fs::path directory;
    if (!input.empty() && input != "-") {
        directory = input;
        if (!fs::is_directory(directory, error)) directory = directory.parent_path();
    }
    const bool whole = directory.is_absolute();
    directory = (here / directory).lexically_normal();
    if (!directory.has_filename()) directory = directory.parent_path();  // it ended in a slash
    for (;;) {
        const fs::path candidate = directory / kConfigName;
        places.push_back((whole ? candidate : candidate.lexically_relative(here)).string());
        if (directory == directory.parent_path()) return places;
        directory = directory.parent_path();
    }
}

bool is_config(const std::string& name) {
    std::error_code error;
    // What is there but cannot be read is found as well, as a link to nothing: reading it will say so.
    const fs::file_status status = fs::status(name, error);
    if (!fs::exists(status)) return fs::is_symlink(fs::symlink_status(name, error));
    return !fs::is_directory(status);
}

std::optional<std::string> find_config(const std::string& input) {
    for (std::string& place : config_places(input)) {
        if (is_config(place)) return std::move(place);
    }
    return std::nullopt;
}

ConfigFile read_config(const std::string& name, const CLI::App& app, const CLI::App& verb) {
    Diagnostics trouble(name);
    std::optional<Source> source = read_settings(name, trouble);
    if (!source) throw UsageError(trouble, {});
    ConfigFile file{name, std::move(source->text), {}};
    if (const std::optional<toml::table> top = parse_toml(file.text, kCode, "a configuration", trouble)) {
        Reader(file, app, verb, trouble).read(*top);
    }
    if (trouble.has_errors()) throw UsageError(trouble, file.text);
    return file;
}

}  // namespace popup::cli
