#include "popup/write.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "base/text/nearest.h"
#include "run/beside.h"

namespace popup {

// The file. nullopt: there is something to tell of it, so that it is to be written in its turn.
struct BegunModel : Beside<std::optional<std::string>> {
    using Beside::Beside;
};

namespace {

template <class... Fs>
struct Overloaded : Fs... {
    using Fs::operator()...;
};
template <class... Fs>
Overloaded(Fs...) -> Overloaded<Fs...>;

Diagnostic& refuse(Diagnostics& diagnostics, std::string message) {
    return diagnostics.error("unwritable-output", {}, std::move(message));
}

template <class Writer>
bool is_written_by(const Format& format) {
    return std::holds_alternative<Writer>(format.write);
}

bool shows_model(const Format& format) {
    return is_written_by<SceneWriter>(format) || is_written_by<StillWriter>(format) ||
           is_written_by<PageWriter>(format);
}

const Format* format_of(const std::string& path, const std::string& otherwise, Diagnostics& diagnostics) {
    if (path != "-") {
        if (const Format* format = find_format(path)) return format;
    }
    if (!otherwise.empty()) {
        if (const Format* format = find_format(otherwise)) return format;
    }
    std::vector<std::string_view> names;
    for (const Format& row : format_table()) names.push_back(row.suffix);
    const std::string formats = fmt::format("formats: {}", fmt::join(names, " "));
    if (path == "-") {
        refuse(diagnostics, "the format of standard output is not known")
            .hint("name it with --to FORMAT")
            .hint(formats);
    } else {
        Diagnostic& told = refuse(diagnostics, fmt::format("{}: the suffix names no format", path));
        const std::size_t dot = path.rfind('.');
        const std::string suffix = dot == std::string::npos ? std::string() : path.substr(dot);
        // What is one slip away: many suffixes are alike.
        const auto meant = std::find_if(names.begin(), names.end(), [&](std::string_view one) {
            return edit_distance(suffix, one) == 1;
        });
        if (meant != names.end()) told.hint(fmt::format("did you mean {}?", *meant));
        told.hint(formats);
    }
    return nullptr;
}

bool choose_formats(const OutputRequest& request, OutputPlan& plan, Diagnostics& diagnostics) {
    for (const std::string& path : request.outputs) {
        if (path.empty()) {
            refuse(diagnostics, "an output has no name");
            return false;
        }
        const Format* format = format_of(path, request.format, diagnostics);
        if (format == nullptr) return false;
        plan.outputs.push_back({path, format});
        if (is_written_by<DocumentWriter>(*format) && request.inputs.size() > 1) {
            refuse(diagnostics,
                   fmt::format("{} is one document, and there are {} inputs", path, request.inputs.size()))
                .hint("build each on its own, or use \"popupc fix --in-place\"");
            return false;
        }
    }
    return true;
}

bool share_standard_output(const OutputRequest& request, Diagnostics& diagnostics) {
    std::vector<std::string> users = request.streams;
    for (const std::string& path : request.outputs) {
        if (is_standard_output(path)) users.push_back("-o " + path);
    }
    for (const OutputRequest::Other& other : request.others) {
        if (!other.name.empty() && is_standard_output(other.path)) users.push_back(other.name);
    }
    if (users.size() <= 1) return true;
    refuse(diagnostics, fmt::format("standard output has more than one user: {}", fmt::join(users, ", ")))
        .hint("--diagnostics FILE and -o FILE take files");
    return false;
}

bool are_files_of_their_own(const OutputRequest& request, Diagnostics& diagnostics) {
    std::vector<std::string> written = request.outputs;
    for (const OutputRequest::Other& other : request.others) written.push_back(other.path);
    for (std::size_t i = 0; i < written.size(); ++i) {
        for (std::size_t j = 0; j < i; ++j) {
            if (!same_place(written[i], written[j])) continue;
            refuse(diagnostics, written[i] == written[j]
                                    ? fmt::format("{} is named twice as an output", written[i])
                                    : fmt::format("{} and {} are the same output", written[j], written[i]));
            return false;
        }
        for (const std::string& input : request.inputs) {
            if (!overwrites(written[i], input)) continue;
            refuse(diagnostics, fmt::format("{} is an input; a build does not overwrite it", written[i]))
                .hint("to write the repaired document over the old one use \"popupc fix --in-place\"");
            return false;
        }
    }
    return true;
}

// What is read as an assembly has no document. Parts that do not move have sheets and a report; also a model,
// where their language says how they stand, and a book, where they are glued together.
enum class Read { assembly, lying_sheet, glued_parts, standing_parts, parts };

// What a model, picture or page of it would lack; empty: nothing.
std::string_view lacking_for(const Format& format, Read what) {
    if (what == Read::assembly) return {};
    if (format.stills == Stills::made)
        return what == Read::lying_sheet || what == Read::glued_parts ? "" : "steps to fold or glue";
    if (what == Read::parts || what == Read::glued_parts) return "moving model";
    return format.stills < (what == Read::lying_sheet ? Stills::sheets : Stills::all) ? "motion" : "";
}

bool can_be_made_of(Read what, const std::string& input, const OutputPlan& plan, Diagnostics& diagnostics) {
    for (const PlannedOutput& output : plan.outputs) {
        std::string_view lacking;
        if (shows_model(*output.format)) lacking = lacking_for(*output.format, what);
        if (is_written_by<DocumentWriter>(*output.format)) lacking = "popup document";
        if (lacking.empty()) continue;
        Diagnostic& told =
            refuse(diagnostics, fmt::format("{}: this {}, and has no {} for {}", input,
                                            what == Read::assembly      ? "is an assembly"
                                            : what == Read::lying_sheet ? "is a sheet that lies folded"
                                                                        : "describes flat parts",
                                            lacking, output.path));
        if (what == Read::assembly) {
            told.hint("a document is written of the design that the assembly was made of");
        } else if (what == Read::lying_sheet) {
            told.hint(
                "build it without --flat to see it move; with --flat there are stills (.view.png) and models "
                "(.glb, .gltf, .fold)");
        } else {
            told.hint(outputs_of_parts(what == Read::standing_parts));
        }
        return false;
    }
    return true;
}

std::vector<Diagnostic> findings_of(const Compilation& run) {
    std::vector<Diagnostic> all;
    const auto add = [&all](const Diagnostics& diagnostics) {
        for (Diagnostic& one : diagnostics.sorted()) all.push_back(std::move(one));
    };
    for (const CompiledDesign& one : run.designs) add(one.diagnostics);
    add(run.run_diagnostics);
    return all;
}

// The files of one output.
std::optional<std::vector<SheetFile>> write_format(const Format& format, const OutputOptions& options,
                                                   const BegunFiles& begun, Compilation& run) {
    Diagnostics& diagnostics = run.run_diagnostics;
    const auto single = [](std::optional<std::string> bytes) -> std::optional<std::vector<SheetFile>> {
        if (!bytes) return std::nullopt;
        std::vector<SheetFile> all;
        all.push_back({"", std::move(*bytes)});
        return all;
    };
    return std::visit(
        Overloaded{
            [&](SheetWriter write) { return write(*run.layout, options, diagnostics); },
            [&](SceneWriter write) {
                const auto found = begun.models.find(&format);
                std::optional<std::string> bytes;
                if (found != begun.models.end()) bytes = found->second->take();
                return single(bytes ? std::move(bytes) : write(scene_of(run), options, diagnostics));
            },
            [&](StillWriter write) { return write(scene_of(run), options, diagnostics); },
            [&](PageWriter write) {
                const std::vector<SceneCard> cards = scene_of(run);
                const bool inches = !cards.empty() && cards.front().assembly->units == UnitSystem::inches;
                RunPage page{cards, &*run.layout, findings_of(run), inches};
                const auto found = begun.pages.find(&format);
                if (found != begun.pages.end()) page.begun = found->second;
                return single(write(page, options, diagnostics));
            },
            [&](DocumentWriter write) {
                return single(write(*run.designs.front().checked, options, diagnostics));
            },
            [&](ReportWriter write) { return single(write(run, options, diagnostics)); },
        },
        format.write);
}

std::shared_ptr<BegunModel> begin_model(SceneWriter write, const Compilation& run, OutputOptions options) {
    const auto work = [write, cards = scene_of(run), options = std::move(options),
                       policy = run.run_diagnostics.policy()] {
        Diagnostics told({}, policy);
        std::optional<std::string> bytes = write(cards, options, told);
        return told.sorted().empty() ? std::move(bytes) : std::nullopt;
    };
    return std::make_shared<BegunModel>(work, true);
}

// What the profile and the sheets have to say to each other, and to the formats of sheets, each once.
void examine_sheets(const OutputPlan& plan, const OutputOptions& options, Compilation& run) {
    std::vector<const Format*> formats;
    for (const PlannedOutput& output : plan.outputs) {
        if (!is_written_by<SheetWriter>(*output.format)) continue;
        if (std::find(formats.begin(), formats.end(), output.format) == formats.end())
            formats.push_back(output.format);
    }
    if (formats.empty()) return;
    examine_profile(*run.layout, options.profile, options.score_side, run.run_diagnostics);
    OutputOptions asked = options;
    // No sheet lacks a legend that its format never has.
    if (std::none_of(formats.begin(), formats.end(), [](const Format* one) { return one->uses.legend; }))
        asked.legend = Legend::never;
    examine_prints(*run.layout, asked, run.run_diagnostics);
    for (const Format* format : formats) {
        examine_format(format->suffix, options.profile, run.run_diagnostics);
    }
}

// "card.svg", "-2" → "card-2.svg".
std::string suffixed(const PlannedOutput& output, const std::string& suffix) {
    const std::string& path = output.path;
    std::size_t stem = path.size();
    const std::size_t length = output.format->suffix.size();
    if (find_format(path) == output.format && stem > length) stem -= length;
    return path.substr(0, stem) + suffix + path.substr(stem);
}

// Pages tell what was found while the others were written; reports come last, for they name every other file.
std::vector<PlannedOutput> in_order_of_making(const OutputPlan& plan) {
    const auto turn = [](const PlannedOutput& output) {
        return is_written_by<ReportWriter>(*output.format) ? 2
               : is_written_by<PageWriter>(*output.format) ? 1
                                                           : 0;
    };
    std::vector<PlannedOutput> outputs = plan.outputs;
    std::stable_sort(outputs.begin(), outputs.end(),
                     [&turn](const PlannedOutput& a, const PlannedOutput& b) { return turn(a) < turn(b); });
    return outputs;
}

}  // namespace

void fit_layout(CompileOptions& options) {
    const Profile& profile = options.output.profile;
    options.layout.bed = {profile.bed_width_mm, profile.bed_height_mm};
    Length& margin = options.layout.margin;
    margin = Length::millimetres(std::max(margin.mm, margin_needed(options.output)));
    const std::string& sheet = options.layout.sheet.name;
    if (!options.output.letter_pages && !sheet.empty() && sheet != "auto")
        options.output.letter_pages = sheet == "letter" || sheet == "legal" || sheet == "tabloid";
}

std::optional<OutputPlan> plan_outputs(const OutputRequest& request, Diagnostics& diagnostics) {
    OutputPlan plan;
    plan.inputs = request.inputs;
    if (!choose_formats(request, plan, diagnostics) || !share_standard_output(request, diagnostics) ||
        !are_files_of_their_own(request, diagnostics)) {
        return std::nullopt;
    }
    for (const std::string& name : request.inputs) {
        const Language* language = find_language(Source{name, {}}, request.language);
        if (name == "-" || language == nullptr || !language->only_parts || request.as != DrawnAs::parts)
            continue;
        if (!can_be_made_of(Read::parts, name, plan, diagnostics)) return std::nullopt;
    }
    return plan;
}

bool can_be_made(const OutputPlan& plan, const Compilation& run, Diagnostics& diagnostics) {
    return std::all_of(run.designs.begin(), run.designs.end(), [&](const CompiledDesign& one) {
        if (one.design || !one.assembly) return true;
        const bool is_sheet = has_model(*one.assembly) && !one.assembly->hinges.empty();
        const bool is_glued = !one.assembly->glue.empty() || !one.assembly->glued_areas.empty();
        const Read what = moves(*one.assembly)       ? Read::assembly
                          : is_sheet                 ? Read::lying_sheet
                          : is_glued                 ? Read::glued_parts
                          : has_model(*one.assembly) ? Read::standing_parts
                                                     : Read::parts;
        return can_be_made_of(what, one.source.name, plan, diagnostics);
    });
}

std::vector<SceneCard> scene_of(const Compilation& run) {
    std::vector<SceneCard> cards;
    const bool several = run.designs.size() > 1;
    for (const CompiledDesign& one : run.designs) {
        SceneCard& card = cards.emplace_back();
        if (several) card.prefix = one.stem + ":";
        card.assembly = &*one.assembly;
        if (one.motion) card.motion = &*one.motion;
        if (one.creases) card.creases = &*one.creases;
        if (one.pattern) card.pattern = &*one.pattern;
        card.input = one.source.name;
    }
    return cards;
}

std::string outputs_of_parts(bool has_model) {
    return fmt::format(
        "of flat parts there are sheets (.svg, .pdf), {}the report (.json), and --emit assembly, pattern or "
        "layout",
        has_model ? "the still model (.glb, .gltf, .html), " : "");
}

void refuse_definitions(Compilation& run) {
    for (CompiledDesign& one : run.designs) {
        if (one.design || one.assembly || one.diagnostics.has_errors()) continue;
        if (one.creases) {
            one.diagnostics
                .error("unwritable-output", {},
                       "no flat state of the sheet was found, so there is nothing to write")
                .hint("without --flat it is folded as far as its panels let it");
            continue;
        }
        one.diagnostics
            .error("flatlang-no-parts", {},
                   "the program defines functions and draws nothing, so there is nothing to write")
            .hint(
                "functions draw when they are called, with the pen down: call them at its end, or load() it "
                "from a "
                "program that does");
    }
}

BegunFiles begin_files(const OutputPlan& plan, const OutputOptions& options, const Compilation& run) {
    Diagnostics told_later;
    if (options.threads < 2 || run.designs.empty() || run.has_errors() ||
        !can_be_made(plan, run, told_later)) {
        return {};
    }
    // Of what ended early nothing is made.
    const bool compiled = std::all_of(run.designs.begin(), run.designs.end(), [](const CompiledDesign& one) {
        return one.assembly && (one.motion || !moves(*one.assembly));
    });
    if (!compiled) return {};
    BegunFiles begun;
    for (const PlannedOutput& output : plan.outputs) {
        const Format* format = output.format;
        if (const SceneWriter* write = std::get_if<SceneWriter>(&format->write)) {
            std::shared_ptr<BegunModel>& model = begun.models[format];
            if (!model) model = begin_model(*write, run, options);
        } else if (format->begin != nullptr) {
            std::shared_ptr<BegunPage>& page = begun.pages[format];
            if (!page) page = format->begin(scene_of(run), options);
        }
    }
    return begun;
}

std::optional<std::vector<PendingFile>> make_files(const OutputPlan& plan, const OutputOptions& options,
                                                   Compilation& run, const BegunFiles& begun) {
    refuse_definitions(run);
    if (run.has_errors() || !can_be_made(plan, run, run.run_diagnostics)) return std::nullopt;
    if (!run.layout && !plan.outputs.empty()) {
        refuse(run.run_diagnostics, "there are no sheets: nothing was compiled, or not as far as the layout");
        return std::nullopt;
    }
    examine_sheets(plan, options, run);
    std::vector<PendingFile> files;
    bool good = true;
    OutputOptions writing = options;
    for (const PlannedOutput& output : in_order_of_making(plan)) {
        auto parts = write_format(*output.format, writing, begun, run);
        if (!parts) {
            // A writer that fails must have said why: no result is ever silently missing.
            POPUP_INVARIANT(run.run_diagnostics.has_errors());
            good = false;
            continue;
        }
        if (parts->size() > 1 && is_standard_output(output.path)) {
            const bool are_pictures = is_written_by<StillWriter>(*output.format);
            refuse(run.run_diagnostics,
                   fmt::format("standard output takes one file, and the {} make {}",
                               are_pictures ? "views and openings" : "sheets, their sides and parts",
                               parts->size()))
                .hint(are_pictures ? "write to a file, or ask for one --view and one opening (--at)"
                                   : "write to a file, or choose a format that holds several (--to pdf)");
            good = false;
            continue;
        }
        for (SheetFile& part : *parts) {
            files.push_back({suffixed(output, part.suffix), std::move(part.bytes)});
            // By name only: the report must not depend on the directory.
            const std::string& path = files.back().path;
            if (!is_standard_output(path)) writing.files.push_back(path.substr(path.rfind('/') + 1));
        }
    }
    if (!good) return std::nullopt;
    return files;
}

bool spares_inputs(const OutputPlan& plan, const std::vector<PendingFile>& files, const Compilation& run,
                   Diagnostics& diagnostics) {
    for (const PendingFile& file : files) {
        // What the plan names has been looked at.
        if (std::any_of(plan.outputs.begin(), plan.outputs.end(),
                        [&file](const PlannedOutput& output) { return output.path == file.path; })) {
            continue;
        }
        for (const std::string& input : plan.inputs) {
            if (!overwrites(file.path, input)) continue;
            refuse(diagnostics,
                   fmt::format("{} is an input, and a further sheet would be written over it", input))
                .hint("give the output another name");
            return false;
        }
    }
    for (const PendingFile& file : files) {
        for (const CompiledDesign& one : run.designs) {
            if (!spares_loaded(file.path, one.further_files, diagnostics)) return false;
        }
    }
    return true;
}

bool spares_loaded(const std::string& output, const std::vector<std::string>& loaded,
                   Diagnostics& diagnostics) {
    for (const std::string& file : loaded) {
        if (!overwrites(output, file)) continue;
        refuse(diagnostics, fmt::format("{} is read by an input of this run, and is not overwritten", file))
            .hint("give the output another name");
        return false;
    }
    return true;
}

std::optional<std::vector<std::string>> write_files(const OutputPlan& plan, const OutputOptions& options,
                                                    Compilation& run, bool keep_identical) {
    const auto files = make_files(plan, options, run);
    if (!files || !spares_inputs(plan, *files, run, run.run_diagnostics) ||
        !write_all(*files, keep_identical, run.run_diagnostics)) {
        return std::nullopt;
    }
    std::vector<std::string> names;
    names.reserve(files->size());
    for (const PendingFile& file : *files) names.push_back(file.path);
    return names;
}

bool output_refused(const Diagnostics& diagnostics) {
    const std::vector<Diagnostic> all = diagnostics.sorted();
    return std::any_of(all.begin(), all.end(), [](const Diagnostic& one) {
        return one.code == "unwritable-output" || one.code == "font-missing" || one.code == "pdf-failed" ||
               one.code == "pdf-page-size" || one.code == "model-too-large" || one.code == "picture-failed" ||
               one.code == "picture-too-large" || one.code == "tiles-impossible" ||
               one.code == "tile-too-small" || one.code == "too-many-tiles";
    });
}

}  // namespace popup
