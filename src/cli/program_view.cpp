#include "cli/program_view.h"

#include <algorithm>

#include "cli/options/command_line.h"
#include "cli/options/dependency_options.h"

namespace popup::cli {
namespace {

std::vector<std::string> words_of(CLI::Option& option) {
    try {
        option.add_result("\x01");
        option.run_callback();
    } catch (const UsageError& error) {
        return error.choices();
    } catch (const CLI::Error&) {
        return {};
    }
    return {};
}

OptionView view_option(CLI::Option& option) {
    OptionView view;
    view.about = option.get_description();
    view.group = option.get_group();
    view.traits = traits_of(option);
    view.required = option.get_required();
    if (option.nonpositional()) {
        for (const std::string& name : option.get_snames()) view.names.push_back("-" + name);
        for (const std::string& name : option.get_lnames()) view.names.push_back(shown_option(name));
        if (!view.traits.flag) view.type = option.get_type_name();
    } else {
        view.names.push_back(option.get_name(true, false));
    }
    if (!view.traits.flag && !view.traits.files) view.words = words_of(option);
    return view;
}

VerbView view_verb(CLI::App& app) {
    VerbView verb{
        app.get_name(), app.get_description(), app.get_footer(), {}, app.get_allow_extras(), {}, {}};
    for (CLI::Option* option : app.get_options()) {
        (option->nonpositional() ? verb.options : verb.positionals).push_back(view_option(*option));
    }
    for (const std::string& group : app.get_groups()) {
        const auto in_group = [&group](const OptionView& option) { return option.group == group; };
        if (std::any_of(verb.options.begin(), verb.options.end(), in_group)) verb.groups.push_back(group);
    }
    // The group of --help was there first and belongs at the end.
    std::stable_partition(verb.groups.begin(), verb.groups.end(),
                          [](const std::string& group) { return group != "Other"; });
    return verb;
}

}  // namespace

ProgramView view_program() {
    Options scratch;
    const std::unique_ptr<CLI::App> app = declare_program(scratch, verb_table());
    ProgramView program;
    program.self = view_verb(*app);
    for (CLI::App* verb : app->get_subcommands([](CLI::App*) { return true; })) {
        program.verbs.push_back(view_verb(*verb));
    }
    return program;
}

}  // namespace popup::cli
