#include "cli/help.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "cli/options/dependency_options.h"
#include "popup/compile.h"

namespace popup::cli {
namespace {

constexpr std::size_t kColumn = 26;

// One line an option or verb: names, the kind of value, and what it does.
std::string entry(const std::string& names, const std::string& about) {
    if (names.size() + 4 > kColumn) return fmt::format("  {}\n{:{}}{}\n", names, "", kColumn, about);
    return fmt::format("  {:<{}}{}\n", names, kColumn - 2, about);
}

class HelpFormatter : public CLI::FormatterBase {
 public:
    std::string make_help(const CLI::App* app, std::string /*name*/,
                          CLI::AppFormatMode /*mode*/) const override {
        const bool is_verb = app->get_parent() != nullptr;
        std::string text = is_verb ? "Usage: popupc " + app->get_name() : "Usage: popupc VERB [OPTIONS] ...";
        const auto positionals = app->get_options([](const CLI::Option* o) { return o->get_positional(); });
        for (const CLI::Option* option : positionals) {
            const std::string name =
                option->get_name(true, false) + (option->get_expected_max() > 1 ? "..." : "");
            text += option->get_required() ? " " + name : " [" + name + "]";
        }
        if (is_verb && app->get_allow_extras()) text += " [EDIT...]";
        text += fmt::format("{}\n\n{}.\n", is_verb ? " [OPTIONS]" : "", app->get_description());
        if (!positionals.empty()) text += "\n";
        for (const CLI::Option* option : positionals) {
            text += entry(option->get_name(true, false), option->get_description());
        }
        const auto verbs = app->get_subcommands([](const CLI::App*) { return true; });
        if (!verbs.empty()) text += "\nVerbs:\n";
        for (const CLI::App* verb : verbs) text += entry(verb->get_name(), verb->get_description());
        std::vector<std::string> groups = app->get_groups();
        // The group of --help was there first and belongs at the end.
        std::stable_partition(groups.begin(), groups.end(),
                              [](const std::string& group) { return group != "Other"; });
        for (const std::string& group : groups) {
            std::string lines;
            for (const CLI::Option* option : app->get_options()) {
                if (option->get_group() == group && option->nonpositional()) lines += line(*option);
            }
            if (!lines.empty()) text += fmt::format("\n{}:\n{}", group, lines);
        }
        return text + "\n" + app->get_footer() + "\n";
    }

 private:
    static std::string line(const CLI::Option& option) {
        std::string names;
        for (const std::string& name : option.get_snames()) names += (names.empty() ? "-" : ", -") + name;
        for (const std::string& name : option.get_lnames()) {
            const std::string shown = shown_option(name);
            names += (names.empty() ? (shown.starts_with("--") ? "    " : "") : ", ") + shown;
        }
        if (option.get_type_size() != 0) names += " " + option.get_type_name();
        return entry(names, option.get_description());
    }
};

const CLI::App* verb_of(const CLI::App& app) {
    const auto named = app.get_subcommands();
    return named.empty() ? nullptr : named.front();
}

// All options of the verb that was named, else of the program.
std::vector<std::string> option_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back(shown_option(name));
    }
    return names;
}

std::vector<std::string> verb_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
        names.push_back(verb->get_name());
    }
    return names;
}

std::vector<std::string> hints_for(const std::string& word, const std::vector<std::string>& names) {
    return did_you_mean(word, std::vector<std::string_view>(names.begin(), names.end()));
}

std::string lower_first(std::string text) {
    // Names of options and codes stay as they are.
    if (text.size() > 1 && text[0] >= 'A' && text[0] <= 'Z' && text[1] >= 'a' && text[1] <= 'z') {
        text[0] = static_cast<char>(text[0] - 'A' + 'a');
    }
    while (text.ends_with('\n') || text.ends_with('.')) text.pop_back();
    return text;
}

}  // namespace

void set_up_help(CLI::App& app) {
    app.formatter(std::make_shared<HelpFormatter>());
    app.set_help_flag("-h,--help", "print this help")->group("Other");
    app.set_version_flag("--version", std::string(version()), "print the program's version")->group("Other");
    app.footer(
        "Examples:\n"
        "  popupc build castle.xml -o castle.pdf -o castle.glb\n"
        "  popupc check designs/*.xml\n"
        "  popupc fix --diff castle.xml\n"
        "\nExit status: 0 nothing to report, 1 findings, 2 wrong usage or unusable files.");
}

std::string help_text(const CLI::App& app) {
    const CLI::App* verb = verb_of(app);
    return verb == nullptr ? app.help() : verb->help();
}

UsageError explained(const CLI::App& app, const CLI::ParseError& error) {
    const CLI::App* verb = verb_of(app);
    const std::string see = fmt::format("see \"popupc{}{} --help\"", verb == nullptr ? "" : " ",
                                        verb == nullptr ? "" : verb->get_name());
    // What a verb takes as it comes, as edit does, is not what is wrong.
    const std::vector<std::string> unknown = app.remaining(verb == nullptr || !verb->get_allow_extras());
    if (!unknown.empty()) {
        // An option that is not known makes its value an argument too many: the option is what is wrong.
        const auto looks_like_option = [](const std::string& text) {
            return text.size() > 1 && text.starts_with('-') && text != "--";
        };
        const auto option = std::find_if(unknown.begin(), unknown.end(), looks_like_option);
        const std::string& first = option == unknown.end() ? unknown.front() : *option;
        std::string word = first.substr(0, first.find('='));
        if (word.starts_with("--")) word = shown_option(word.substr(2));
        const bool is_option = looks_like_option(word);
        if (verb == nullptr && !is_option) {
            auto hints = hints_for(word, verb_names(app));
            hints.push_back(fmt::format("verbs: {}", fmt::join(verb_names(app), " ")));
            return UsageError(fmt::format("there is no verb \"{}\"", word), hints).blame({}, first);
        }
        auto hints = hints_for(word, option_names(verb == nullptr ? app : *verb));
        if (is_option && verb != nullptr && verb->get_name() == "batch") {
            hints.emplace_back("options of builds stand behind --, or in the manifest");
        }
        if ((word == "-o" || word == "--output") && verb != nullptr && verb->get_name() == "view") {
            hints.emplace_back("view writes nothing; \"popupc build\" writes files");
        }
        hints.push_back(see);
        return UsageError(is_option ? fmt::format("there is no option {}", word)
                                    : fmt::format("\"{}\" is one argument too many", word),
                          hints)
            .blame({}, first);
    }
    if (verb == nullptr) {
        return UsageError("name a verb", {fmt::format("verbs: {}", fmt::join(verb_names(app), " ")), see});
    }
    if (error.get_name() == "RequiredError") {
        for (const CLI::Option* option : verb->get_options()) {
            if (!option->get_required() || !option->get_positional() || option->count() > 0) continue;
            return UsageError(fmt::format("{} is missing: {} needs {}", option->get_name(true, false),
                                          verb->get_name(), option->get_description()),
                              {see});
        }
    }
    // "--emit: At Most 1 required but received 2", of an option that takes one value.
    const std::string said = error.what();
    const std::size_t end = said.find(": At Most 1 required but received ");
    if (end != std::string::npos)
        return UsageError(fmt::format("{} is given more than once", said.substr(0, end)), {see});
    return UsageError(lower_first(said), {see});
}

}  // namespace popup::cli
