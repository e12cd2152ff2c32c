#include <CLI/CLI.hpp>
#include <optional>
#include <utility>

#include "cli/files/inputs.h"
#include "cli/files/outputs.h"
#include "cli/files/read_files.h"
#include "cli/judge.h"
#include "cli/report.h"
#include "cli/verbs.h"

namespace popup::cli {

CLI::App* add_check(CLI::App& app, Options& options) {
    CLI::App* verb = app.add_subcommand("check", "Report everything wrong or doubtful; write nothing");
    add_input_options(*verb, options);
    add_tree_options(*verb, options);
    add_check_options(*verb, options);
    add_sheet_options(*verb, options);
    add_nest_options(*verb, options);
    add_motion_options(*verb, options);
    add_program_options(*verb, options);
    add_message_options(*verb, options);
    add_policy_options(*verb, options);
    add_judge_options(*verb, options);
    add_config_options(*verb, options);
    add_thread_option(*verb, options);
    verb->footer(
        "Examples:\n"
        "  popupc check designs/\n"
        "  popupc check castle.xml --repair never --werror\n"
        "  popupc check castle.xml --sheet a4\n"
        "  popupc check *.xml --message-format sarif > findings.sarif\n"
        "  popupc check designs/ --baseline accepted.json --write-baseline\n"
        "  popupc check designs/ --baseline accepted.json\n"
        "\nExit status 0 when there is nothing to report, 1 after any warning or error.");
    return verb;
}

int run_check(const Options& options) {
    check_motion_options(options);
    check_judge_options(options);
    check_print_options(options);
    InputFiles files = find_inputs(options);
    spare(files_read(options, files.names, files.ignore_files), options);
    clear_litter({options.messages.file, options.judge.write_baseline ? options.judge.baseline : ""});
    const std::optional<BaselineFile> baseline = load_baseline(options);
    if (baseline && !baseline->is) {
        report(options.messages, {{&baseline->diagnostics, baseline->source.text, false}}, Diagnostics());
        return exit_unusable;
    }
    // Without a sheet there is nothing to lay out: inputs that are checked together need not be one run.
    Run run = run_inputs(options, std::move(files), options.sheet_given ? Stage::layout : Stage::pattern,
                         options.sheet_given ? Keep::everything : Keep::findings);
    check_loaded(run, options.messages.file);
    check_loaded(run, options.print.file);
    say_layers(options.messages, run.compilation);
    tell_printed(options, run);
    const bool printed = write_printed(options, run, run.compilation.run_diagnostics);
    Findings findings = collect(run.findings(), run.compilation.run_diagnostics);
    bool usable = run.usable() && printed;
    if (options.judge.write_baseline) {
        // What could not be read may have findings that are accepted already.
        if (usable) usable = accept_all(options, *baseline->is, findings);
    } else if (baseline) {
        judge(options, *baseline->is, findings);
    }
    const bool fail = findings.fail();
    const bool told = options.judge.statistics ? report_statistics(options.messages, std::move(findings))
                                               : report(options.messages, std::move(findings));
    if (!usable || !told) return exit_unusable;
    return fail ? exit_findings : exit_done;
}

}  // namespace popup::cli
