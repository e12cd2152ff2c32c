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
    static constexpr Verb kVerbs[] = {{add_build, run_build},
                                      {add_check, run_check},
                                      {add_view, run_view},
                                      {add_fix, run_fix},
                                      {add_edit, run_edit},
                                      {add_show, run_show},
                                      {add_new, run_new},
                                      {add_fmt, run_fmt},
                                      {add_batch, run_batch},
                                      {add_merge_reports, run_merge_reports},
                                      {add_gallery, run_gallery},
                                      {add_trace, run_trace},
                                      {add_suggest, run_suggest},
                                      {add_lsp, run_lsp},
                                      {add_explain, run_explain},
                                      {add_list, run_list},
                                      {add_completions, run_completions},
                                      {add_manual, run_manual}};
    return kVerbs;
}

std::unique_ptr<CLI::App> declare_program(Options& options) {
    auto app = std::make_unique<CLI::App>(
        "A batch compiler for pop-up paper designs: documents in, cut sheets and a moving model out",
        "popupc");
    set_up_help(*app);
    for (const Verb& verb : verb_table()) verb.add(*app, options)->get_help_ptr()->group("Other");
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

}  // namespace

std::variant<Command, std::string> read_command(std::vector<std::string> arguments) {
    Command command;
    command.options.arguments = arguments;
    Options& options = command.options;
    arguments = expand_response_files(arguments, options.settings_files);
    arguments = with_long_dependency_options(arguments);
    protect_brackets(arguments);
    const std::unique_ptr<CLI::App> program = declare_program(options);
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
        throw explained(app, error);
    }
    for (std::size_t i = 0; i < verbs.size(); ++i) {
        if (!verbs[i]->parsed()) continue;
        if (verbs[i]->get_name() == "edit") options.edit.words = verbs[i]->remaining();
        command.verb = &verb_table()[i];
        for (const CLI::Option* option : verbs[i]->get_options()) {
            if (option->count() > 0) options.given.insert(traits_of(*option).key);
        }
        const Settings settings = apply_settings(app, *verbs[i], options);
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
