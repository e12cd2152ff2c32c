#include "cli/files/outputs.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "cli/files/inputs.h"
#include "cli/options/dependency_options.h"
#include "output/emit.h"
#include "output/emit_design.h"

namespace popup::cli {
namespace {

template <class... Fs>
struct Overloaded : Fs... {
    using Fs::operator()...;
};
template <class... Fs>
Overloaded(Fs...) -> Overloaded<Fs...>;

std::vector<std::string_view> format_names() {
    std::vector<std::string_view> names;
    for (const Format& row : format_table()) names.push_back(row.suffix);
    return names;
}

const Format& format_of(const std::string& path, const BuildOptions& options) {
    if (path != "-") {
        if (const Format* format = find_format(path)) return *format;
    }
    if (!options.format.empty()) {
        if (const Format* format = find_format(options.format)) return *format;
    }
    const std::string formats = fmt::format("formats: {}", fmt::join(format_names(), " "));
    if (path == "-") {
        throw UsageError("the format of standard output is not known", {"name it with --to FORMAT", formats});
    }
    throw UsageError(fmt::format("{}: the suffix names no format", path), {formats});
}

void check_format_option(const std::vector<std::string>& outputs, const std::string& format) {
    if (format.empty()) return;
    for (const std::string& path : outputs) {
        if (path == "-" || find_format(path) == nullptr) return;
    }
    throw UsageError("--to names the format of standard output, and nothing goes there", {"add \"-o -\""});
}

std::string canonical(const std::string& path) {
    std::error_code error;
    const std::filesystem::path whole = std::filesystem::absolute(path, error);
    if (error) return path;
    const std::filesystem::path result = std::filesystem::weakly_canonical(whole, error);
    return error ? path : result.string();
}

// "card.svg", "-2" → "card-2.svg".
std::string suffixed(const std::string& path, const Format& format, const std::string& suffix) {
    std::size_t stem = path.size();
    if (find_format(path) == &format && path.size() > format.suffix.size()) stem -= format.suffix.size();
    return path.substr(0, stem) + suffix + path.substr(stem);
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

std::vector<SceneCard> scene_of(const Compilation& compilation) {
    std::vector<SceneCard> cards;
    const bool several = compilation.designs.size() > 1;
    for (const CompiledDesign& one : compilation.designs) {
        SceneCard& card = cards.emplace_back();
        if (several) card.prefix = one.stem + ":";
        card.assembly = &*one.assembly;
        if (one.motion) card.motion = &*one.motion;
    }
    return cards;
}

// The files of one output.
std::optional<std::vector<SheetFile>> write_format(const Format& format, const OutputOptions& options,
                                                   Compilation& compilation) {
    Diagnostics& diagnostics = compilation.run_diagnostics;
    const auto single = [](std::optional<std::string> bytes) -> std::optional<std::vector<SheetFile>> {
        if (!bytes) return std::nullopt;
        std::vector<SheetFile> all;
        all.push_back({"", std::move(*bytes)});
        return all;
    };
    return std::visit(
        Overloaded{
            [&](SheetWriter write) { return write(*compilation.layout, options, diagnostics); },
            [&](SceneWriter write) { return single(write(scene_of(compilation), options, diagnostics)); },
            [&](DocumentWriter write) {
                return single(write(*compilation.designs.front().checked, options, diagnostics));
            },
            [&](ReportWriter write) { return single(write(compilation, options, diagnostics)); },
        },
        format.write);
}

// Parts that do not move have sheets and a report; also a model, where their language says how they stand.
void check_parts(const std::string& input, bool has_model, const std::vector<PlannedOutput>& outputs,
                 const std::optional<Emit>& emit) {
    const auto refuse = [&](const std::string& what) {
        throw UsageError(
            fmt::format("{}: this describes flat parts, and has no {}", input, what),
            {fmt::format("of flat parts there are sheets (.svg, .pdf), {}the report (.json), and "
                         "--emit pattern or layout",
                         has_model ? "the still model (.glb, .gltf), " : "")});
    };
    for (const PlannedOutput& output : outputs) {
        if (std::holds_alternative<SceneWriter>(output.format->write)) {
            if (!has_model) refuse(fmt::format("moving model for {}", output.path));
            if (!output.format->takes_stills) refuse(fmt::format("motion for {}", output.path));
        }
        if (std::holds_alternative<DocumentWriter>(output.format->write)) {
            refuse(fmt::format("popup document for {}", output.path));
        }
    }
    if (emit == Emit::design) refuse("design");
    if (emit == Emit::assembly) refuse("assembly");
    if (emit == Emit::motion) refuse("motion");
}

void examine_formats(const std::vector<PlannedOutput>& outputs, const Profile& profile,
                     Diagnostics& diagnostics) {
    std::vector<const Format*> seen;
    for (const PlannedOutput& output : outputs) {
        if (!std::holds_alternative<SheetWriter>(output.format->write)) continue;
        if (std::find(seen.begin(), seen.end(), output.format) != seen.end()) continue;
        seen.push_back(output.format);
        examine_format(output.format->suffix, profile, diagnostics);
    }
}

}  // namespace

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

bool is_standard_output(const std::string& path) {
    return path == "-" || path == "/dev/stdout" || path == "/dev/fd/1" || path == "/proc/self/fd/1";
}

void check_format_name(const std::string& name) {
    if (find_format(name) != nullptr) return;
    std::vector<std::string_view> plain = format_names();
    for (std::string_view& one : plain) one.remove_prefix(1);
    throw UsageError(fmt::format("--to: there is no format \"{}\"", name),
                     {fmt::format("formats: {}", fmt::join(format_names(), " "))}, plain);
}

bool same_place(const std::string& a, const std::string& b) {
    if (a == b || (is_standard_output(a) && is_standard_output(b))) return true;
    if (a == "-" || b == "-") return false;
    struct stat one {};
    struct stat two {};
    if (::stat(a.c_str(), &one) == 0 && ::stat(b.c_str(), &two) == 0) {
        return one.st_dev == two.st_dev && one.st_ino == two.st_ino;
    }
    return canonical(a) == canonical(b);
}

bool overwrites(const std::string& output, const std::string& input) {
    if (input == "-" || is_standard_output(output)) return false;
    struct stat status {};
    // A device, such as a terminal, may well be both.
    if (::stat(input.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return false;
    return same_place(output, input);
}

std::vector<PlannedOutput> plan_outputs(const Options& options) {
    const BuildOptions& build = options.build;
    if (build.outputs.empty() && !build.emit) {
        throw UsageError("nothing to build: name an output with -o",
                         {"the suffix picks the format: -o card.pdf",
                          fmt::format("formats: {}", fmt::join(format_names(), " "))});
    }
    std::vector<PlannedOutput> planned;
    std::vector<std::string> standard;
    if (build.emit) standard.emplace_back("--emit");
    if (options.messages.use_standard_output()) standard.emplace_back("the diagnostics");
    for (const std::string& path : build.outputs) {
        if (path.empty()) throw UsageError("-o takes the name of a file");
        if (is_standard_output(path)) standard.push_back("-o " + path);
        planned.push_back({path, &format_of(path, build)});
        const bool is_document = std::holds_alternative<DocumentWriter>(planned.back().format->write);
        if (is_document && options.inputs.names.size() > 1) {
            throw UsageError(
                fmt::format("{} is one document, and there are {} inputs", path, options.inputs.names.size()),
                {"build each on its own, or use \"popupc fix --in-place\""});
        }
    }
    const std::string& print = options.print.file;
    if (is_standard_output(print)) standard.push_back("--print " + print);
    const std::string dependencies = dependency_file_name(options);
    if (is_standard_output(dependencies)) standard.push_back("-MF " + dependencies);
    check_format_option(build.outputs, build.format);
    if (standard.size() > 1) {
        throw UsageError(fmt::format("standard output has more than one user: {}", fmt::join(standard, ", ")),
                         {"--diagnostics FILE and -o FILE take files"});
    }
    std::vector<std::string> written = build.outputs;
    if (!options.messages.file.empty()) written.push_back(options.messages.file);
    if (!dependencies.empty()) written.push_back(dependencies);
    if (!print.empty()) written.push_back(print);
    for (std::size_t i = 0; i < written.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (!same_place(written[i], written[j])) continue;
            throw UsageError(written[i] == written[j]
                                 ? fmt::format("{} is named twice as an output", written[i])
                                 : fmt::format("{} and {} are the same output", written[j], written[i]));
        }
        for (const std::string& input : options.inputs.names) {
            if (!overwrites(written[i], input)) continue;
            throw UsageError(
                fmt::format("{} is an input; a build does not overwrite it", written[i]),
                {"to write the repaired document over the old one use \"popupc fix --in-place\""});
        }
    }
    for (const std::string& name : options.inputs.names) {
        const Language* language = find_language(Source{name, {}}, options.inputs.language);
        if (name != "-" && language != nullptr && language->only_parts) {
            check_parts(name, false, planned, build.emit);
        }
    }
    if (build.emit == Emit::trail && planned.empty() && !print.empty()) {
        throw UsageError(
            "--print has nothing to write: what programs print stands in what --emit trail prints",
            {"take it from there (\"stdout\"), or build something with -o"});
    }
    return planned;
}

bool output_refused(const Diagnostics& diagnostics) {
    const std::vector<Diagnostic> all = diagnostics.sorted();
    return std::any_of(all.begin(), all.end(), [](const Diagnostic& one) {
        return one.code == "unwritable-output" || one.code == "font-missing" || one.code == "pdf-failed" ||
               one.code == "pdf-page-size" || one.code == "model-too-large" || one.code == "picture-failed" ||
               one.code == "picture-too-large";
    });
}

Stage needed_stage(const std::vector<PlannedOutput>& outputs, const std::optional<Emit>& emit) {
    // Whatever is written has been looked at whole: a sheet of a card that does not close would be a wrong
    // one.
    if (!outputs.empty() || !emit) return Stage::layout;
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

std::optional<std::vector<PendingFile>> make_files(const std::vector<PlannedOutput>& outputs,
                                                   const Options& options, Compilation& compilation) {
    // Of programs and of standard input it is known only now.
    for (const CompiledDesign& one : compilation.designs) {
        if (one.assembly && !moves(*one.assembly)) {
            check_parts(one.source.name, has_model(*one.assembly), outputs, options.build.emit);
        }
    }
    const bool has_sheets = std::any_of(outputs.begin(), outputs.end(), [](const PlannedOutput& output) {
        return std::holds_alternative<SheetWriter>(output.format->write);
    });
    if (has_sheets && compilation.layout) {
        const OutputOptions& output = options.compile.output;
        examine_profile(*compilation.layout, output.profile, output.score_side, compilation.run_diagnostics);
        examine_prints(output, compilation.run_diagnostics);
        examine_formats(outputs, output.profile, compilation.run_diagnostics);
    }
    std::vector<PendingFile> files;
    bool good = true;
    OutputOptions writing = options.compile.output;
    // Reports come last: they name every other file of the run.
    std::vector<PlannedOutput> in_order = outputs;
    std::stable_partition(in_order.begin(), in_order.end(), [](const PlannedOutput& output) {
        return !std::holds_alternative<ReportWriter>(output.format->write);
    });
    for (const PlannedOutput& output : in_order) {
        auto parts = write_format(*output.format, writing, compilation);
        if (!parts) {
            // A writer that fails must have said why: no result is ever silently missing.
            POPUP_INVARIANT(compilation.run_diagnostics.has_errors());
            good = false;
            continue;
        }
        if (parts->size() > 1 && is_standard_output(output.path)) {
            compilation.run_diagnostics
                .error("unwritable-output", {},
                       fmt::format(
                           "standard output takes one file, and the sheets, their sides and parts make {}",
                           parts->size()))
                .hint(
                    "write to a file, choose a larger --sheet, or a format that holds several sheets (--to "
                    "pdf)");
            good = false;
            continue;
        }
        for (SheetFile& part : *parts) {
            files.push_back({suffixed(output.path, *output.format, part.suffix), std::move(part.bytes)});
            // By name only: the report must not depend on the directory.
            const std::string& path = files.back().path;
            if (!is_standard_output(path)) writing.files.push_back(path.substr(path.rfind('/') + 1));
        }
    }
    if (options.build.emit) files.push_back({"-", emitted(*options.build.emit, options, compilation)});
    if (!good) return std::nullopt;
    return files;
}

}  // namespace popup::cli
