#include "cli/files/inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <set>
#include <system_error>
#include <utility>

#include "base/nth.h"
#include "cli/batch/jobserver.h"
#include "cli/files/tree_walk.h"
#include "cli/options/config.h"
#include "cli/options/config_file.h"
#include "cli/progress.h"

namespace popup::cli {
namespace {

namespace fs = std::filesystem;

bool is_directory(const std::string& name) {
    std::error_code error;
    return name != "-" && fs::is_directory(name, error);
}

// The file itself, by whatever links it is reached; its name where it cannot be found out.
std::string identity(const std::string& name) {
    std::error_code error;
    const fs::path path = fs::canonical(name, error);
    return error ? name : path.string();
}

WalkOptions walk_options(const InputOptions& inputs, Walked walked) {
    WalkOptions walk;
    for (const std::string& pattern : inputs.include) walk.include.add(pattern);
    for (const std::string& pattern : inputs.exclude) walk.exclude.add(pattern);
    if (!inputs.include.empty() && !inputs.language.empty()) {
        walk.wants = [](std::string_view) { return true; };
    } else if (!inputs.language.empty()) {
        const Language* language = find_language({}, inputs.language);
        walk.wants = [language](std::string_view name) {
            return find_language({std::string(name), {}}, {}) == language;
        };
    } else {
        // Drawings have the suffix of pictures, and of what the program writes: they are asked for.
        const bool all = !inputs.include.empty();
        walk.wants = [all, walked](std::string_view name) {
            const Language* language = find_language({std::string(name), {}}, {});
            if (language == nullptr) return false;
            return all || (language->walked && (walked == Walked::all || language->patch != nullptr));
        };
    }
    return walk;
}

// ".xml, .oa and .fl"
std::string walked_suffixes(Walked walked) {
    std::vector<std::string_view> suffixes;
    for (const Language& row : language_table()) {
        if (row.walked && (walked == Walked::all || row.patch != nullptr)) suffixes.push_back(row.suffix);
    }
    const std::string_view last = suffixes.back();
    suffixes.pop_back();
    return suffixes.empty() ? std::string(last) : fmt::format("{} and {}", fmt::join(suffixes, ", "), last);
}

std::string trail_of(const Options& options, const Source& source, Diagnostics& diagnostics,
                     std::vector<std::string>& loaded) {
    const Language& language = language_of(options.inputs, source);
    if (language.trail == nullptr) {
        throw UsageError(fmt::format("{}: this is no program, and has no trail", source.name),
                         {"of FlatLang programs (.fl) --emit trail prints what the turtle drew"});
    }
    ReadOptions read = options.compile.read;
    read.language = language.name;
    return language.trail(source, read, diagnostics, loaded);
}

void check_names(const std::vector<std::string>& names) {
    if (std::count(names.begin(), names.end(), "-") > 1)
        throw UsageError("standard input can be read only once");
    if (std::count(names.begin(), names.end(), "") > 0) {
        throw UsageError("an input has an empty name",
                         {"a variable of the shell or of the makefile may be empty"});
    }
}

// A name whose suffix tells no language is wrong usage, unless there is no such file to begin with.
void check_languages(const Options& options, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        if (name == "-" || find_language({name, {}}, options.inputs.language) != nullptr) continue;
        Diagnostics trouble;
        if (const auto source = read_source(name, trouble)) language_of(options.inputs, *source);
    }
}

// No error ended the stages of the design before the one that looks last.
bool is_whole(const CompiledDesign& one) { return one.pattern || !one.diagnostics.has_errors_as_given(); }

// Compiles each file in its turn and keeps what was found.
void look_at_each(Run& run, const Options& options, const CompileOptions& compile_options) {
    const std::vector<std::string>& names = run.files.names;
    run.apart.resize(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) run.order.push_back(-1 - static_cast<int>(i));
    std::vector<std::string> said(options.messages.verbose ? names.size() : 0);
    std::atomic<bool> readable{true};
    const auto source = [&](std::size_t i) {
        Diagnostics trouble(names[i]);
        std::optional<Source> text = read_source(names[i], trouble);
        if (!text) {
            readable = false;
            run.apart[i].diagnostics = std::move(trouble);
        }
        return text;
    };
    const auto done = [&](std::size_t i, CompiledDesign&& one) {
        if (!said.empty()) said[i] = layers_line(one);
        Run::Apart& kept = run.apart[i];
        kept.printed = std::move(one.printed);
        kept.loaded = std::move(one.further_files);
        kept.whole = is_whole(one);
        if (one.diagnostics.sorted().empty()) {
            kept.diagnostics = Diagnostics(names[i]);
            return;
        }
        kept.diagnostics = std::move(one.diagnostics);
        kept.text = std::move(one.source.text);
        kept.text.shrink_to_fit();
    };
    compile_each(names.size(), source, done, compile_options, options.policy);
    run.readable = readable;
    for (const std::string& line : said) {
        if (!line.empty()) say(options.messages, line);
    }
}

// Reads the files, as far as they can be read.
std::vector<Source> read_all(Run& run, const Options& options) {
    std::vector<Source> sources;
    for (const std::string& name : run.files.names) {
        Diagnostics diagnostics(name);
        std::optional<Source> source = read_source(name, diagnostics);
        if (source) {
            language_of(options.inputs, *source);
            run.order.push_back(static_cast<int>(sources.size()));
            sources.push_back(std::move(*source));
        } else {
            run.order.push_back(-1 - static_cast<int>(run.apart.size()));
            run.apart.push_back({std::move(diagnostics), {}, {}, {}});
            run.readable = false;
        }
    }
    return sources;
}

// Configurations below a directory that is walked, which the files there may be thought to have.
void tell_of_configurations(const std::string& top, const std::vector<std::string>& found,
                            const Options& options, InputFiles& files) {
    if (is_configuration_chosen(options)) return;
    std::set<std::string> seen;
    fs::path end = fs::path(top).lexically_normal();
    if (end == ".") end.clear();
    for (const std::string& file : found) {
        for (fs::path directory = fs::path(file).lexically_normal().parent_path();
             directory.string().size() > end.string().size() && seen.insert(directory.string()).second;
             directory = directory.parent_path()) {
            const std::string config = (directory / kConfigName).string();
            if (!is_config(config)) continue;
            Diagnostics one(config, options.policy);
            one.remark("config-ignored", {},
                       "this is not looked at: one run has one configuration, that of " + top)
                .hint("check " + directory.string() +
                      " in a run of its own, or name one for all with --config");
            files.directories.emplace_back(files.names.size(), std::move(one));
        }
    }
}

}  // namespace

InputFiles find_inputs(const Options& options, Walked walked) {
    const InputOptions& inputs = options.inputs;
    InputFiles files;
    if (std::none_of(inputs.names.begin(), inputs.names.end(), is_directory)) {
        files.names = inputs.names;
        return files;
    }
    std::set<std::string> taken;
    for (const std::string& name : inputs.names) {
        if (name != "-" && !is_directory(name)) taken.insert(identity(name));
    }
    const WalkOptions walk = walk_options(inputs, walked);
    for (const std::string& name : inputs.names) {
        if (!is_directory(name)) {
            files.names.push_back(name);
            continue;
        }
        TreeWalk tree = walk_tree(name, walk, options.policy);
        if (tree.files.empty() && tree.unreadable.empty()) {
            Diagnostics none(name, options.policy);
            none.warning("no-designs", {}, "there is no design in this directory")
                .hint(inputs.include.empty() && inputs.exclude.empty()
                          ? fmt::format("designs are {} files; --include '*.svg' asks for drawings",
                                        walked_suffixes(walked))
                          : std::string("--include and --exclude leave nothing of it"));
            files.directories.emplace_back(files.names.size(), std::move(none));
        }
        std::move(tree.ignore_files.begin(), tree.ignore_files.end(), std::back_inserter(files.ignore_files));
        for (Diagnostics& trouble : tree.unreadable) {
            files.directories.emplace_back(files.names.size(), std::move(trouble));
            files.readable = false;
        }
        tell_of_configurations(name, tree.files, options, files);
        for (std::string& file : tree.files) {
            if (taken.insert(identity(file)).second) files.names.push_back(std::move(file));
        }
    }
    return files;
}

std::vector<FileFindings> Run::findings() const {
    std::vector<FileFindings> all;
    all.reserve(order.size() + files.directories.size());
    auto directory = files.directories.begin();
    for (std::size_t i = 0; i <= order.size(); ++i) {
        for (; directory != files.directories.end() && directory->first == i; ++directory) {
            all.push_back({&directory->second, {}, false});
        }
        if (i == order.size()) break;
        const int index = order[i];
        if (index < 0) {
            const Apart& one = nth(apart, -1 - index);
            all.push_back({&one.diagnostics, one.text, true, one.whole});
        } else {
            const CompiledDesign& one = nth(compilation.designs, index);
            all.push_back({&one.diagnostics, one.source.text, true, is_whole(one)});
        }
    }
    return all;
}

bool Run::has_findings() const {
    return compilation.has_findings() ||
           std::any_of(apart.begin(), apart.end(),
                       [](const Apart& one) { return one.diagnostics.has_findings(); }) ||
           std::any_of(files.directories.begin(), files.directories.end(),
                       [](const auto& one) { return one.second.has_findings(); });
}

void check_inputs(const Options& options, const std::vector<std::string>& names) {
    check_names(names);
    check_languages(options, names);
}

const Language& language_of(const InputOptions& options, const Source& source) {
    if (const Language* language = find_language(source, options.language)) return *language;
    const std::string suffix = std::filesystem::path(source.name).extension().string();
    if (suffix == ".dwg" || suffix == ".DWG") {
        throw UsageError(fmt::format("{}: DWG is not read", source.name),
                         {"save the drawing as ASCII DXF, of any version from R12 to 2018"});
    }
    throw UsageError(fmt::format("{}: the suffix names no language", source.name),
                     {"languages: " + known_languages(), "--from LANGUAGE says what the file holds"});
}

namespace {

// compile(), with pages of the plan begun once there is all that they need but the sheets.
void compile_beside_pages(std::vector<Source> sources, const CompileOptions& options,
                          const DiagnosticPolicy& policy, const OutputPlan& plan, Run& run) {
    CompileOptions first = options;
    first.until = Stage::pattern;
    run.compilation = compile(std::move(sources), first, policy);
    run.begun = begin_files(plan, options.output, run.compilation);
    lay_out_run(run.compilation, options);
}

}  // namespace

Run run_inputs(const Options& options, InputFiles files, Stage until, Keep keep, const OutputPlan* plan) {
    check_names(files.names);
    Run run;
    run.files = std::move(files);
    std::vector<Source> sources;
    if (keep == Keep::everything) {
        sources = read_all(run, options);
    } else {
        check_languages(options, run.files.names);
    }
    CompileOptions compile_options = options.compile;
    compile_options.read.language = options.inputs.language;
    compile_options.until = until;
    compile_options.progress = progress_meter(options.messages, run.files.names.size());
    NestEffort& nesting = compile_options.layout.nesting;
    nesting.progress = nesting_meter(options.messages);
    // Who asked for a time may find it long enough sooner; else an interrupted run writes nothing.
    if (nesting.seconds && nesting.stop == nullptr) nesting.stop = stop_on_interrupt();
    Jobserver jobserver(options.jobs_given ? nullptr : std::getenv("MAKEFLAGS"));
    ask_before_threads(jobserver, compile_options);
    if (!jobserver.trouble().empty()) say(options.messages, jobserver.trouble());
    if (keep == Keep::everything && plan != nullptr && until == Stage::layout) {
        compile_beside_pages(std::move(sources), compile_options, options.policy, *plan, run);
    } else if (keep == Keep::everything) {
        run.compilation = compile(std::move(sources), compile_options, options.policy);
    } else {
        look_at_each(run, options, compile_options);
    }
    return run;
}

Run run_trails(const Options& options, std::vector<std::string>& trails) {
    const std::vector<std::string>& names = options.inputs.names;
    check_names(names);
    Run run;
    run.files.names = names;
    run.compilation.run_diagnostics = Diagnostics({}, options.policy);
    for (Source& source : read_all(run, options)) {
        CompiledDesign one;
        one.diagnostics = Diagnostics(source.name, options.policy);
        one.source = std::move(source);
        trails.push_back(trail_of(options, one.source, one.diagnostics, one.further_files));
        run.compilation.designs.push_back(std::move(one));
    }
    return run;
}

std::vector<std::string> trails_of(const Options& options, const Compilation& compilation) {
    std::vector<std::string> trails;
    for (const CompiledDesign& one : compilation.designs) {
        Diagnostics unheard;
        std::vector<std::string> known;
        trails.push_back(trail_of(options, one.source, unheard, known));
    }
    return trails;
}

Run run_inputs(const Options& options, Stage until, const OutputPlan* plan) {
    InputFiles files;
    files.names = options.inputs.names;
    return run_inputs(options, std::move(files), until, Keep::everything, plan);
}

std::string_view what_it_is(const Language& language) {
    if (language.trail != nullptr) return "is a program";
    if (language.only_parts) return "describes flat parts";
    return language.drawn ? "is a drawing" : "is none";
}

void check_is_document(const Source& source, const ReadOptions& read, std::string_view takes) {
    const Language* language = find_language(source, read.language);
    if (language == nullptr || language->patch != nullptr) return;
    const bool is_card = language->drawn && read.drawing.as == DrawnAs::card;
    throw UsageError(
        fmt::format("{}: {}, and this {}", source.name, takes,
                    is_card ? "is a drawing of a card" : what_it_is(*language)),
        {language->drawn ? "popupc fix --as card DRAWING -o card.xml makes a document of a drawn card"
         : language->trail != nullptr
             ? "if it makes a card, popupc build -o card.xml writes the document of that"
             : "change it in the program that made it"});
}

}  // namespace popup::cli
