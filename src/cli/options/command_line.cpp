#include "cli/options/command_line.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <utility>

#include "cli/help.h"
#include "cli/options/config.h"
#include "cli/options/dependency_options.h"
#include "cli/options/response_files.h"
#include "cli/options/value_option.h"
#include "cli/verbs.h"
#include "popup/compile.h"

namespace popup::cli {

std::span<const Verb> verb_table() {
    static constexpr Verb kVerbs[] = {{"build", add_build, run_build},
                                      {"check", add_check, run_check},
                                      {"view", add_view, run_view},
                                      {"fix", add_fix, run_fix},
                                      {"edit", add_edit, run_edit},
                                      {"show", add_show, run_show},
                                      {"new", add_new, run_new},
                                      {"fmt", add_fmt, run_fmt},
                                      {"batch", add_batch, run_batch},
                                      {"merge-reports", add_merge_reports, run_merge_reports},
                                      {"gallery", add_gallery, run_gallery},
                                      {"trace", add_trace, run_trace},
                                      {"suggest", add_suggest, run_suggest},
                                      {"lsp", add_lsp, run_lsp},
                                      {"explain", add_explain, run_explain},
                                      {"list", add_list, run_list},
                                      {"completions", add_completions, run_completions},
                                      {"manual", add_manual, run_manual}};
    return kVerbs;
}

std::unique_ptr<CLI::App> declare_program(Options& options, std::span<const Verb> verbs) {
    auto app = std::make_unique<CLI::App>(
        "A batch compiler for pop-up paper designs: documents in, cut sheets and a moving model out",
        "popupc");
    set_up_help(*app);
    for (const Verb& verb : verbs) verb.add(*app, options)->get_help_ptr()->group("Other");
    app->require_subcommand(1);
    return app;
}

namespace {

// To the parser "[a,b]" is a list of two; here it is the name of a file.
void protect_brackets(std::vector<std::string>& arguments) {
    for (std::size_t i = 1; i < arguments.size(); ++i) {
        const bool list = arguments[i].starts_with('[') && arguments[i].ends_with(']');
        // Values of options are not taken apart.
        const bool value = arguments[i - 1].starts_with('-') && arguments[i - 1] != "--";
        if (list && !value) arguments[i].insert(0, "./");
    }
}

// The verbs that a command line can mean: the one that it begins with, else all. Options of a verb are some
// hundred, and take a parser as long to declare as a small card takes to compile.
std::span<const Verb> meant(const std::vector<std::string>& arguments) {
    const std::span<const Verb> all = verb_table();
    if (arguments.empty()) return all;
    if (arguments.size() == 1 && arguments.front() == "--version") return {};
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (arguments.front() == all[i].name) return all.subspan(i, 1);
    }
    return all;
}

}  // namespace

std::variant<Command, std::string> read_command(std::vector<std::string> arguments) {
    Command command;
    command.options.arguments = arguments;
    Options& options = command.options;
    const ExpandedWords expanded = expand_response_files(arguments, options.settings_files);
    try {
        arguments = with_long_dependency_options(expanded.words);
    } catch (const UsageError& error) {
        throw placed(error, expanded);
    }
    protect_brackets(arguments);
    const std::span<const Verb> rows = meant(arguments);
    const std::unique_ptr<CLI::App> program = declare_program(options, rows);
    CLI::App& app = *program;
    const std::vector<CLI::App*> verbs = app.get_subcommands([](const CLI::App*) { return true; });
    // Settings can be looked at before there is anything to do with them.
    if (std::find(arguments.begin(), arguments.end(), "--print-config") != arguments.end()) {
        for (CLI::App* verb : verbs) {
            for (CLI::Option* option : verb->get_options()) option->required(false);
        }
    }
    // The parser takes them from the end.
    std::reverse(arguments.begin(), arguments.end());
    try {
        app.parse(std::move(arguments));
    } catch (const CLI::CallForHelp&) {
        return help_text(app);
    } catch (const CLI::CallForVersion&) {
        return fmt::format("popupc {}\n", version());
    } catch (const CLI::ParseError& error) {
        throw placed(explained(app, error), expanded);
    } catch (const UsageError& error) {
        throw placed(error, expanded);
    }
    for (std::size_t i = 0; i < verbs.size(); ++i) {
        if (!verbs[i]->parsed()) continue;
        if (verbs[i]->get_name() == "edit") options.edit.words = verbs[i]->remaining();
        command.verb = &rows[i];
        for (const CLI::Option* option : verbs[i]->get_options()) {
            if (option->count() > 0) options.given.insert(traits_of(*option).key);
        }
        const Settings settings = apply_settings(*verbs[i], options);
        for (const CLI::Option* option : verbs[i]->get_options()) {
            if (option->count() > 0) options.settings[traits_of(*option).key] = option->results();
        }
        // What is defined for a whole directory need not concern every program in it.
        constexpr std::string_view kUnused = "flatlang-unused-definition";
        if (settings.origins.contains("define") && !options.policy.deny.contains(kUnused)) {
            options.policy.allow.emplace(kUnused);
        }
        if (options.config.print) return render_settings(*verbs[i], settings, options.unknown_variables);
    }
    return command;
}

}  // namespace popup::cli
