#include "cli/build.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <utility>

#include "cli/files/dependency_file.h"
#include "cli/files/outputs.h"
#include "cli/files/read_files.h"
#include "cli/options/still_options.h"
#include "cli/options/tile_options.h"
#include "cli/options/unused_options.h"
#include "cli/options/value_option.h"
#include "cli/report.h"
#include "cli/verbs.h"
#include "cli/watch.h"

namespace popup::cli {
namespace {

constexpr double kYear10000 = 253402300800;  // in seconds since 1970

void add_output_options(CLI::App& verb, Options& options) {
    BuildOptions& build = options.build;
    verb.add_option("-o,--output", build.outputs, "write this file; its suffix picks the format. Repeatable")
        ->type_name("FILE")
        ->allow_extra_args(false)
        ->configurable(false)
        ->group("Output");
    verb.add_option_function<std::string>(
            "--to",
            [&build](const std::string& text) {
                check_format_name(text);
                build.format = text;
            },
            "format of standard output (\"-o -\"), such as svg")
        ->type_name("FORMAT")
        ->configurable(false)
        ->group("Output");
    verb.add_option_function<std::string>(
            "--emit",
            [&build](const std::string& text) {
                build.emit = choose<Emit>("--emit", text,
                                          {{"design", Emit::design},
                                           {"assembly", Emit::assembly},
                                           {"motion", Emit::motion},
                                           {"pattern", Emit::pattern},
                                           {"layout", Emit::layout},
                                           {"trail", Emit::trail}});
            },
            "print design, assembly, motion, pattern, layout or trail as JSON")
        ->type_name("STAGE")
        ->configurable(false)
        ->group("Output");
    verb.add_flag("--if-changed", build.if_changed, "leave files alone that hold the same bytes already")
        ->group("Output");
    verb.add_flag("--watch", build.watch, "build again whenever an input changes, until Ctrl-C")
        ->configurable(false)
        ->group("Output");
    add_animation_options(verb, options);
    add_still_options(verb, options.compile.output.still);
    value(verb, "--edge-lines", "WHETHER",
          "on (default) or off: lines along cut edges and folds in .glb and .gltf", "Output",
          [&options](std::string_view text) {
              options.compile.output.edge_lines =
                  choose<bool>("--edge-lines", text, {{"on", true}, {"off", false}});
          });
    value(
        verb, "--fold-dialect", "DIALECT", "letters in .fold: simulator (default) or strict, all of FOLD 1.2",
        "Output", [&options](std::string_view text) {
            options.compile.output.fold_dialect =
                choose<FoldDialect>("--fold-dialect", text,
                                    {{"simulator", FoldDialect::simulator}, {"strict", FoldDialect::strict}});
        });
}

// "297.0 x 210.0 mm", or of several sizes each once: "305.0 x 305.0 and 420.0 x 297.0 mm".
std::string sheet_sizes(const Layout& layout) {
    std::vector<std::string> sizes;
    for (const LayoutSheet& sheet : layout.sheets) {
        std::string size = fmt::format("{:.1f} x {:.1f}", sheet.width_mm, sheet.height_mm);
        if (std::find(sizes.begin(), sizes.end(), size) == sizes.end()) sizes.push_back(std::move(size));
    }
    return fmt::format("{} mm", fmt::join(sizes, " and "));
}

void tell(const Options& options, const Build& build) {
    if (!options.messages.verbose) return;
    say_layers(options.messages, build.run.compilation);
    if (build.run.compilation.layout) {
        const Layout& layout = *build.run.compilation.layout;
        say(options.messages,
            fmt::format("{} sheet{} of {}, {} piece{}", layout.sheets.size(),
                        layout.sheets.size() == 1 ? "" : "s", sheet_sizes(layout), layout.placements.size(),
                        layout.placements.size() == 1 ? "" : "s"));
    }
    for (const PendingFile& file : build.files) {
        say(options.messages,
            fmt::format("wrote {} ({} bytes)", file.path == "-" ? "standard output" : file.path,
                        file.bytes.size()));
    }
}

}  // namespace

CLI::App* add_build(CLI::App& app, Options& options) {
    CLI::App* verb = app.add_subcommand("build", "Compile documents into sheets, models and reports");
    add_input_options(*verb, options);
    add_output_options(*verb, options);
    add_dependency_options(*verb, options);
    add_profile_options(*verb, options);
    add_tile_options(*verb, options);
    add_check_options(*verb, options);
    add_sheet_options(*verb, options);
    add_nest_options(*verb, options);
    add_motion_options(*verb, options);
    add_program_options(*verb, options);
    add_message_options(*verb, options);
    add_policy_options(*verb, options);
    add_config_options(*verb, options);
    add_thread_option(*verb, options);
    verb->footer(
        "Examples:\n"
        "  popupc build castle.xml -o castle.pdf -o castle.glb\n"
        "  popupc build *.xml --copies 4 --sheet a3 -o run.svg\n"
        "  popupc build castle.xml --to svg -o - | lp -o scaling=100\n"
        "  popupc build castle.xml --emit motion --angles 0:180:1\n"
        "  popupc build gear.fl -D teeth=24 -I parts -o gear.svg\n"
        "\nNothing is written when anything is wrong: exit status 1, or 2 for wrong usage.");
    return verb;
}

std::vector<FileFindings> Build::findings() const {
    std::vector<FileFindings> all = run.findings();
    if (profile && !profile->diagnostics.sorted().empty()) {
        all.insert(all.begin(), {&profile->diagnostics, profile->source.text, false});
    }
    return all;
}

namespace {

std::vector<std::string> paths_of(const std::vector<PendingFile>& files) {
    std::vector<std::string> paths;
    paths.reserve(files.size());
    for (const PendingFile& file : files) paths.push_back(file.path);
    return paths;
}

// Adds the dependency file, where one is wanted. Where it cannot be, the diagnostics have an error.
void add_dependency_file(const Options& options, const Build& result, std::vector<PendingFile>& files,
                         Diagnostics& diagnostics) {
    const std::string path = dependency_file_name(options);
    if (path.empty()) return;
    const DependencyOptions& wanted = options.build.dependencies;
    const std::vector<std::string> inputs = names_of_files(result.inputs);
    const std::vector<std::string> outputs = paths_of(files);
    std::optional<std::string> text = wanted.format == DependencyFormat::make
                                          ? dependency_rule(wanted.targets.empty() ? outputs : wanted.targets,
                                                            inputs, wanted.phony, path, diagnostics)
                                          : dependency_json(inputs, outputs, path, diagnostics);
    // Always anew: where outputs keep their times, it tells when they were last made sure of.
    if (text) files.push_back({path, std::move(*text), true});
}

// As JSON it tells what a failed run has read, too.
void tell_dependencies_of_failure(const Options& options, Build& result) {
    const std::string path = dependency_file_name(options);
    if (path.empty() || options.build.dependencies.format != DependencyFormat::json) return;
    // What kept the outputs from being written may be this file, and has been told then.
    Diagnostics told;
    Diagnostics& run = result.run.compilation.run_diagnostics;
    Diagnostics& diagnostics = output_refused(run) ? told : run;
    const auto text = dependency_json(names_of_files(result.inputs), std::nullopt, path, diagnostics);
    if (!text || !write_all({{path, *text}}, false, diagnostics)) result.status = exit_unusable;
}

// What programs have loaded is known only now: it is an input like others.
void take_in_loaded(const Options& options, Build& result) {
    std::vector<std::string> loaded = loaded_files(result.run);
    for (const std::string& output :
         {options.messages.file, options.print.file, dependency_file_name(options)}) {
        check_loaded(result.run, output);
    }
    std::move(loaded.begin(), loaded.end(), std::back_inserter(result.inputs));
    for (const CompiledDesign& one : result.run.compilation.designs) {
        result.missing.insert(result.missing.end(), one.missing_files.begin(), one.missing_files.end());
    }
}

// What there is to write of a run that came to nothing: what the programs printed, and their trails.
void write_what_was_run(const Options& options, Build& result) {
    std::vector<PendingFile> files;
    if (!options.print.file.empty()) files.push_back({options.print.file, printed_text(result.run)});
    if (options.build.emit == Emit::trail && result.run.usable()) {
        files.push_back({"-", json_list(trails_of(options, result.run.compilation))});
    }
    if (files.empty()) return;
    if (options.build.before_writing) options.build.before_writing(files);
    if (!write_all(files, options.build.if_changed, result.run.compilation.run_diagnostics))
        result.status = exit_unusable;
}

// Trails alone: programs are run, and nothing is made of what they draw.
void print_trails(const Options& options, Build& result) {
    std::vector<std::string> trails;
    result.run = run_trails(options, trails);
    take_in_loaded(options, result);
    Compilation& compilation = result.run.compilation;
    bool written = true;
    if (result.run.usable()) {
        std::vector<PendingFile> files{{"-", json_list(std::move(trails))}};
        written = write_all(files, false, compilation.run_diagnostics);
        if (written) result.files = std::move(files);
    }
    if (!result.run.usable() || !written) {
        result.status = exit_unusable;
    } else if (compilation.has_errors()) {
        result.status = exit_findings;
    }
}

// A date that is none would silently be left out of PDF files.
void check_source_date() {
    const char* text = std::getenv("SOURCE_DATE_EPOCH");
    if (text == nullptr || *text == '\0') return;
    const std::optional<double> seconds = parse_number(text);
    if (seconds && *seconds >= 0.0 && *seconds < kYear10000 && *seconds == std::floor(*seconds)) return;
    throw UsageError(fmt::format("SOURCE_DATE_EPOCH is \"{}\", and takes whole seconds since 1970", text),
                     {"\"date +%s\" prints such a number"});
}

std::vector<std::string> inputs_of(const Options& options) {
    std::vector<std::string> inputs = options.inputs.names;
    if (!options.build.profile_file.empty()) inputs.push_back(options.build.profile_file);
    inputs.insert(inputs.end(), options.settings_files.begin(), options.settings_files.end());
    return inputs;
}

// False where the profile cannot be used.
bool take_in_profile(Options& options, Build& result) {
    result.profile = load_profile(options);
    if (result.profile && result.profile->diagnostics.has_errors()) {
        result.status = result.profile->readable ? exit_findings : exit_unusable;
        return false;
    }
    finish_profile(options);
    return true;
}

void run_stages(const Options& options, Stage until, const OutputPlan* plan, Build& result) {
    result.run = run_inputs(options, until, plan);
    take_in_loaded(options, result);
    for (const CompiledDesign& one : result.run.compilation.designs) {
        if (options.build.emit != Emit::design || !one.creases) continue;
        throw UsageError(fmt::format("{}: this is a folded sheet, and has no design", one.source.name),
                         {"it has --emit assembly, motion, pattern or layout"});
    }
    // To check them is one thing, but nothing can be built of programs that only define what others call.
    refuse_definitions(result.run.compilation);
}

void settle_status(bool written, Build& result) {
    if (!result.run.usable() || !written) {
        result.status = exit_unusable;
    } else if (result.run.compilation.has_errors()) {
        result.status = exit_findings;
    }
}

// From the profile on.
void compile_and_write(Options& options, const OutputPlan& plan, const ReadFiles& read, Build& result) {
    if (!take_in_profile(options, result)) return;
    finish_tiles(options, plan);
    if (plan.outputs.empty() && options.build.emit == Emit::trail) {
        print_trails(options, result);
        return;
    }
    run_stages(options, needed_stage(plan, options.build.emit), &plan, result);
    Compilation& compilation = result.run.compilation;
    tell_unused_options(options, plan, compilation.designs, compilation.run_diagnostics);
    bool written = true;
    if (result.run.usable() && !compilation.has_errors()) {
        auto files = files_of(plan, options, compilation, result.run.begun);
        if (files && !options.print.file.empty()) {
            files->push_back({options.print.file, printed_text(result.run)});
        }
        if (files) add_dependency_file(options, result, *files, compilation.run_diagnostics);
        if (files && !compilation.has_errors()) {
            Diagnostics told;
            if (!spares_inputs(plan, *files, compilation, told)) refuse_usage(told);
            for (const PendingFile& file : *files) read.spare(file.path, "a further sheet");
            if (options.build.before_writing) options.build.before_writing(*files);
            written = write_all(*files, options.build.if_changed, compilation.run_diagnostics);
            if (written) result.files = std::move(*files);
        } else {
            written = !output_refused(compilation.run_diagnostics);
        }
    }
    settle_status(written, result);
    if (result.status != exit_done && written) write_what_was_run(options, result);
}

}  // namespace

Build build(const Options& given) {
    Options options = given;
    check_source_date();
    check_motion_options(options);
    const OutputPlan plan = plan_of(options);
    Build result;
    result.inputs = inputs_of(options);
    const ReadFiles read = files_read(options, options.inputs.names);
    spare(read, options);
    compile_and_write(options, plan, read, result);
    if (result.status != exit_done) tell_dependencies_of_failure(options, result);
    return result;
}

Build compile_inputs(Options& options, Stage until) {
    check_motion_options(options);
    Build result;
    result.inputs = inputs_of(options);
    if (!take_in_profile(options, result)) return result;
    run_stages(options, until, nullptr, result);
    settle_status(true, result);
    return result;
}

int run_build(const Options& options) {
    std::vector<std::string> outputs = options.build.outputs;
    outputs.push_back(options.messages.file);
    clear_litter(outputs);
    if (options.build.watch) return run_watch(options);
    const Build done = build(options);
    if (done.status == exit_done) tell(options, done);
    tell_printed(options, done.run);
    if (done.status == exit_unusable && reader_has_gone()) return exit_unusable;
    const bool told = report(options.messages, done.findings(), done.run.compilation.run_diagnostics);
    return told ? done.status : exit_unusable;
}

}  // namespace popup::cli
