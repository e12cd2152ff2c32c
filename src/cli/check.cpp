#include <CLI/CLI.hpp>

#include "cli/inputs.h"
#include "cli/report.h"
#include "cli/verbs.h"

namespace popup::cli {

CLI::App* add_check(CLI::App& app, Options& options) {
    CLI::App* verb = app.add_subcommand("check", "Report everything wrong or doubtful; write nothing");
    add_input_options(*verb, options);
    add_check_options(*verb, options);
    add_sheet_options(*verb, options);
    add_nest_options(*verb, options);
    add_motion_options(*verb, options);
    add_message_options(*verb, options);
    add_policy_options(*verb, options);
    add_config_options(*verb, options);
    add_thread_option(*verb, options);
    verb->footer(
        "Examples:\n"
        "  popupc check designs/*.xml\n"
        "  popupc check castle.xml --repair never --werror\n"
        "  popupc check castle.xml --sheet a4\n"
        "  popupc check *.xml --message-format json > findings.jsonl\n"
        "\nExit status 0 when there is nothing to report, 1 after any warning or error.");
    return verb;
}

int run_check(const Options& options) {
    check_motion_options(options);
    // Without a sheet there is nothing to lay out: inputs that are checked together need not be one run.
    const Run run = run_inputs(options, options.sheet_given ? Stage::layout : Stage::pattern);
    say_layers(options.messages, run.compilation);
    const bool told = report(options.messages, run.findings(), run.compilation.run_diagnostics);
    if (!run.usable() || !told) return exit_unusable;
    return run.compilation.has_findings() ? exit_findings : exit_done;
}

}  // namespace popup::cli
