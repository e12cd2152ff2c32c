// The verbs. Each is declared to the parser by its add function and done by its run function, which returns
// the exit code. The options are those the parser filled.
#pragma once

#include "cli/options/options.h"

namespace popup::cli {

CLI::App* add_build(CLI::App& app, Options& options);
int run_build(const Options& options);

CLI::App* add_check(CLI::App& app, Options& options);
int run_check(const Options& options);

CLI::App* add_view(CLI::App& app, Options& options);
int run_view(const Options& options);

CLI::App* add_fix(CLI::App& app, Options& options);
int run_fix(const Options& options);

CLI::App* add_batch(CLI::App& app, Options& options);
int run_batch(const Options& options);

CLI::App* add_merge_reports(CLI::App& app, Options& options);
int run_merge_reports(const Options& options);

CLI::App* add_gallery(CLI::App& app, Options& options);
int run_gallery(const Options& options);

CLI::App* add_trace(CLI::App& app, Options& options);
int run_trace(const Options& options);

CLI::App* add_lsp(CLI::App& app, Options& options);
int run_lsp(const Options& options);

CLI::App* add_edit(CLI::App& app, Options& options);
int run_edit(const Options& options);

CLI::App* add_suggest(CLI::App& app, Options& options);
int run_suggest(const Options& options);

CLI::App* add_show(CLI::App& app, Options& options);
int run_show(const Options& options);

CLI::App* add_fmt(CLI::App& app, Options& options);
int run_fmt(const Options& options);

CLI::App* add_new(CLI::App& app, Options& options);
int run_new(const Options& options);

CLI::App* add_explain(CLI::App& app, Options& options);
int run_explain(const Options& options);

CLI::App* add_list(CLI::App& app, Options& options);
int run_list(const Options& options);

CLI::App* add_completions(CLI::App& app, Options& options);
int run_completions(const Options& options);

CLI::App* add_manual(CLI::App& app, Options& options);
int run_manual(const Options& options);

}  // namespace popup::cli
