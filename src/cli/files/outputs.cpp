#include "cli/files/outputs.h"

#include <fmt/format.h>

#include <filesystem>
#include <set>
#include <utility>

#include "cli/files/inputs.h"
#include "cli/options/dependency_options.h"
#include "output/emit.h"
#include "output/emit_design.h"

namespace popup::cli {
namespace {

std::vector<std::string_view> format_names() {
    std::vector<std::string_view> names;
    for (const Format& row : format_table()) names.push_back(row.suffix);
    return names;
}

void check_format_option(const std::vector<std::string>& outputs, const std::string& format) {
    if (format.empty()) return;
    for (const std::string& path : outputs) {
        if (path == "-" || find_format(path) == nullptr) return;
    }
    throw UsageError("--to names the format of standard output, and nothing goes there", {"add \"-o -\""});
}

std::string emitted(Emit what, const Options& options, const Compilation& compilation) {
    if (what == Emit::layout) return emit_layout(*compilation.layout);
    if (what == Emit::trail) return json_list(trails_of(options, compilation));
    const auto one = [what](const CompiledDesign& design) {
        switch (what) {
            case Emit::design:
                return emit_design(*design.design);
            case Emit::assembly:
                return emit_assembly(*design.assembly);
            case Emit::motion:
                return emit_motion(*design.assembly, *design.motion);
            case Emit::pattern:
                return emit_pattern(*design.pattern);
            case Emit::layout:
            case Emit::trail:
                break;
        }
        broken_invariant("only stages with a document of their own are emitted", __FILE__, __LINE__);
    };
    std::vector<std::string> documents;
    for (const CompiledDesign& design : compilation.designs) documents.push_back(one(design));
    return json_list(std::move(documents));
}

// Of flat parts there are no values of the stages that fold and move a card.
void check_emitted(Emit what, const std::string& input, bool has_model) {
    if (what != Emit::design && what != Emit::motion) return;
    const std::string_view stage = what == Emit::design ? "design" : "motion";
    throw UsageError(fmt::format("{}: this describes flat parts, and has no {}", input, stage),
                     {outputs_of_parts(has_model)});
}

OutputRequest request_of(const Options& options) {
    OutputRequest request{.outputs = options.build.outputs,
                          .format = options.build.format,
                          .inputs = options.inputs.names,
                          .language = options.inputs.language,
                          .as = options.compile.read.drawing.as.value_or(DrawnAs::parts)};
    if (options.build.emit) request.streams.emplace_back("--emit");
    if (options.messages.use_standard_output()) request.streams.emplace_back("the diagnostics");
    const auto add = [&request](const std::string& path, const std::string& name) {
        if (!path.empty()) request.others.push_back({path, name.empty() ? name : name + " " + path});
    };
    add(options.messages.file, {});
    add(dependency_file_name(options), "-MF");
    add(options.print.file, "--print");
    if (!options.suggest.accept.empty()) add(options.suggest.refinement, "--refinement");
    return request;
}

}  // namespace

void refuse_usage(const Diagnostics& told) {
    const Diagnostic first = told.sorted().front();
    throw UsageError(first.message, first.hints);
}

std::string json_list(std::vector<std::string> documents) {
    if (documents.size() == 1) return std::move(documents.front());
    std::string text = "[\n";
    for (std::string& one : documents) {
        while (one.ends_with('\n')) one.pop_back();
        if (text.size() > 2) text += ",\n";
        text += one;
    }
    return text + "\n]\n";
}

void check_format_name(const std::string& name) {
    if (find_format(name) != nullptr) return;
    std::vector<std::string_view> plain = format_names();
    for (std::string_view& one : plain) one.remove_prefix(1);
    throw UsageError(fmt::format("--to: there is no format \"{}\"", name),
                     {fmt::format("formats: {}", fmt::join(format_names(), " "))}, plain);
}

OutputPlan plan_of(const Options& options) {
    const BuildOptions& build = options.build;
    if (build.outputs.empty() && !build.emit) {
        throw UsageError("nothing to build: name an output with -o",
                         {"the suffix picks the format: -o card.pdf",
                          fmt::format("formats: {}", fmt::join(format_names(), " "))});
    }
    for (const std::string& path : build.outputs) {
        if (path.empty()) throw UsageError("-o takes the name of a file");
    }
    Diagnostics told;
    const std::optional<OutputPlan> plan = plan_outputs(request_of(options), told);
    if (!plan) refuse_usage(told);
    check_format_option(build.outputs, build.format);
    for (const std::string& name : options.inputs.names) {
        const Language* language = find_language(Source{name, {}}, options.inputs.language);
        if (build.emit && name != "-" && language != nullptr && language->only_parts &&
            options.compile.read.drawing.as.value_or(DrawnAs::parts) == DrawnAs::parts) {
            check_emitted(*build.emit, name, false);
        }
    }
    if (build.emit == Emit::trail && plan->outputs.empty() && !options.print.file.empty()) {
        throw UsageError(
            "--print has nothing to write: what programs print stands in what --emit trail prints",
            {"take it from there (\"stdout\"), or build something with -o"});
    }
    return *plan;
}

void keep_apart(const Options& options) {
    Diagnostics told;
    if (!plan_outputs(request_of(options), told)) refuse_usage(told);
}

void clear_litter(const std::vector<std::string>& files) {
    std::set<std::string> directories;
    for (const std::string& file : files) {
        if (file.empty() || is_standard_output(file)) continue;
        directories.insert(std::filesystem::path(file).parent_path().string());
    }
    for (const std::string& directory : directories) remove_litter(directory);
}

Stage needed_stage(const OutputPlan& plan, const std::optional<Emit>& emit) {
    // Whatever is written has been looked at whole: a sheet of a card that does not close would be a wrong
    // one.
    if (!plan.outputs.empty() || !emit) return Stage::layout;
    switch (*emit) {
        case Emit::design:
        case Emit::trail:
            return Stage::design;
        case Emit::assembly:
            return Stage::assembly;
        case Emit::motion:
            return Stage::motion;
        case Emit::pattern:
            return Stage::pattern;
        case Emit::layout:
            return Stage::layout;
    }
    broken_invariant("what is emitted is one of its enumerators", __FILE__, __LINE__);
}

std::optional<std::vector<PendingFile>> files_of(const OutputPlan& plan, const Options& options,
                                                 Compilation& compilation, const BegunFiles& begun) {
    // Of programs and of standard input it is known only now.
    Diagnostics told;
    if (!can_be_made(plan, compilation, told)) refuse_usage(told);
    const std::optional<Emit> emit = options.build.emit;
    for (const CompiledDesign& one : compilation.designs) {
        if (!emit || one.design || !one.assembly) continue;
        if (!moves(*one.assembly)) {
            check_emitted(*emit, one.source.name, has_model(*one.assembly));
        } else if (*emit == Emit::design) {
            throw UsageError(fmt::format("{}: this is an assembly, and has no design", one.source.name),
                             {"it has --emit assembly, motion, pattern or layout"});
        }
    }
    auto files = make_files(plan, options.compile.output, compilation, begun);
    if (files && emit) files->push_back({"-", emitted(*emit, options, compilation)});
    return files;
}

void check_document_name(const std::string& name, std::string_view verb) {
    if (name.empty() || name == "-") return;
    const Format* format = find_format(name);
    const Language* language = find_language({name, {}}, {});
    const bool is_document = format != nullptr ? std::holds_alternative<DocumentWriter>(format->write)
                                               : language == nullptr || language->patch != nullptr;
    if (is_document) return;
    throw UsageError(fmt::format("{} is a {} file, and {} writes documents", name,
                                 format != nullptr ? format->suffix : language->suffix, verb),
                     {format != nullptr ? "popupc build writes such files" : "name it such as card.xml"});
}

}  // namespace popup::cli
