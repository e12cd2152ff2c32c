#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>

#include "cli/files/outputs.h"
#include "cli/files/read_files.h"
#include "cli/options/value_option.h"
#include "cli/report.h"
#include "cli/verbs.h"
#include "output/book/suggestions.h"
#include "popup/edit_drawing.h"
#include "popup/files.h"
#include "popup/refinement.h"

namespace popup::cli {
namespace {

using Json = nlohmann::ordered_json;

double rounded(double mm) { return std::round(mm * 1e4) / 1e4 + 0.0; }

std::string left_open(bool closes, double mm) { return closes ? "closes" : "leaves " + shown_gap(mm); }

std::string like_text(const Suggestion& row) {
    if (row.like.empty()) return {};
    return fmt::format("; like merge {}", fmt::join(row.like, ", "));
}

std::string as_text(const Suggestions& found, const Ruler& ruler) {
    std::string text = fmt::format("{} suggestion{} within {:.1f} mm; corners meet already in {} place{}\n",
                                   found.rows.size(), found.rows.size() == 1 ? "" : "s", found.near_mm,
                                   found.met.size(), found.met.size() == 1 ? "" : "s");
    if (found.left_out > 0) text += fmt::format("{} more are left out\n", found.left_out);
    for (const Suggestion& row : found.rows) {
        text += fmt::format("{:<12}{:>7.2f} mm apart, {}{}\n", row.name(), row.apart_mm, shown_outcome(row),
                            like_text(row));
        for (const JoinPart& part : row.join.parts) {
            text += "    " + part.panel;
            if (row.join.kind == JoinKind::merge) text += " " + shown_point(ruler, part.corner);
            text += "\n";
        }
        text += row.lies() ? "    accept it where glue holds it there\n"
                           : "    " + shown_turn(row.furthest) + "\n";
    }
    return text;
}

double rounded_deg(double deg) { return std::round(deg * 1e2) / 1e2 + 0.0; }

Json as_json(const FoldTurn& turn) {
    if (turn.panels[0].empty()) return nullptr;
    return {{"panels", turn.panels},
            {"from_deg", rounded_deg(turn.from_deg)},
            {"to_deg", rounded_deg(turn.to_deg)}};
}

Json as_json(const Suggestions& found, const Ruler& ruler) {
    Json rows = Json::array();
    for (const Suggestion& row : found.rows) {
        Json parts = Json::array();
        for (const JoinPart& part : row.join.parts) {
            Json& one = parts.emplace_back(Json{{"panel", part.panel}});
            if (row.join.kind != JoinKind::merge) continue;
            const Vec2 corner = corner_as_shown(ruler, part.corner);
            one["corner"] = {rounded(corner.x), rounded(corner.y)};
        }
        rows.push_back({{"name", row.name()},
                        {"parts", std::move(parts)},
                        {"apart_mm", rounded(row.apart_mm)},
                        {"residual_mm", row.closes ? 0.0 : std::round(row.residual_mm * 1e7) / 1e7},
                        {"turn_deg", rounded_deg(row.turn_deg)},
                        {"furthest_fold", as_json(row.furthest)},
                        {"closes", row.closes},
                        {"like", row.like}});
    }
    return {{"near_mm", rounded(found.near_mm)},
            {"unit", ruler.unit},  // of corners
            {"met", found.met.size()},
            {"left_out", found.left_out},
            {"suggestions", std::move(rows)}};
}

// How each join is left by the refinement, and how far it turns folds.
std::string as_text(const std::vector<Join>& joins, const Refined& refined, double enough,
                    const Ruler& ruler) {
    std::string text;
    bool all_lie = true;
    for (std::size_t i = 0; i < joins.size(); ++i) {
        const double apart = refined.apart_mm[i];
        const bool lies = joins[i].kind == JoinKind::glue && apart <= enough;
        text += fmt::format("{}: {}\n", shown_join(joins[i], ruler),
                            lies ? "lies there already" : left_open(apart <= enough, apart));
        all_lie = all_lie && lies;
    }
    if (!all_lie) text += shown_turn(refined.furthest) + "\n";
    return text;
}

// Whether a file is of suggestions, by its name: "suggestions.html", "box.suggestions.pdf".
bool shows_suggestions(std::string_view path) {
    const std::string name = std::filesystem::path(path).filename().string();
    return name == "suggestions.html" || name == "suggestions.pdf" || name.ends_with(".suggestions.html") ||
           name.ends_with(".suggestions.pdf");
}
bool shows_suggestions(const Options& options) {
    return std::any_of(options.build.outputs.begin(), options.build.outputs.end(),
                       [](const std::string& path) { return shows_suggestions(path); });
}

void check_suggest_usage(const Options& options) {
    const SuggestVerbOptions& verb = options.suggest;
    const bool prints = options.build.outputs.end() !=
                        std::find(options.build.outputs.begin(), options.build.outputs.end(), "-");
    if (options.messages.use_standard_output() || prints) {
        throw UsageError(
            "standard output has two users: the suggestions and what -o or the diagnostics put there",
            {"-o FILE and --diagnostics FILE take files"});
    }
    if (verb.json && !verb.accept.empty())
        throw UsageError("--json lists suggestions, and --accept accepts them", {"leave one out"});
    const auto of_sheet = std::find_if(options.build.outputs.begin(), options.build.outputs.end(),
                                       [](const std::string& path) { return !shows_suggestions(path); });
    const bool refines = of_sheet != options.build.outputs.end();
    if (shows_suggestions(options) && !verb.accept.empty())
        throw UsageError("pages of suggestions show what is not accepted yet, and --accept accepts it",
                         {"leave one out, or name the output otherwise"});
    if (shows_suggestions(options) && refines)
        throw UsageError(
            fmt::format(
                "pages of suggestions show what is not accepted yet, and -o {} writes the refined sheet",
                *of_sheet),
            {"make two commands of it, or call pages *.suggestions.html or *.suggestions.pdf"});
    if (verb.json && refines)
        throw UsageError("--json lists suggestions, and -o writes the refined sheet", {"leave one out"});
    if (is_standard_output(verb.refinement) || is_standard_output(verb.drawing))
        throw UsageError("suggest takes files by their names, not \"-\"");
}

// What the verb reads, and its findings.
struct Inputs {
    std::optional<Source> drawing, refinement;
    Diagnostics of_drawing, of_refinement, trouble;
    CreasePattern pattern;
    std::vector<Join> joins;
    bool usable = true;
};

// The sheet with its allowances: all that follows is of it.
void allow_for_board(FoldOptions& fold, Inputs& in) {
    if (!fold.board_mm) return;
    auto allowed = allow_for_board(in.pattern, fold, *fold.board_mm, in.of_drawing);
    fold.board_mm.reset();
    if (!allowed || !allowed->moved) return;
    in.pattern = std::move(allowed->pattern);
    fold.fold_angles.clear();
    fold.snap_mm = 0.02;  // it is mended
}

// False: it cannot be worked with.
bool read_inputs(const Options& options, Inputs& in) {
    const SuggestVerbOptions& verb = options.suggest;
    in.of_drawing = Diagnostics(verb.drawing, options.policy);
    in.of_refinement = Diagnostics(verb.refinement, options.policy);
    in.drawing = read_source(verb.drawing, in.of_drawing);
    // What is about to be written need not be there yet.
    // One that cannot be looked for is read, and that says why it cannot.
    std::error_code no_look;
    const bool is_new =
        !verb.accept.empty() && !std::filesystem::exists(verb.refinement, no_look) && !no_look;
    if (!verb.refinement.empty() && !is_new) {
        in.refinement = read_source(verb.refinement, in.of_refinement);
        in.usable = in.refinement.has_value();
    }
    in.usable = in.usable && in.drawing.has_value();
    if (!in.usable) return false;
    Reading reading = read_source_text(*in.drawing, options.compile.read, in.of_drawing);
    if (!reading.creases) {
        if (!in.of_drawing.has_errors())
            throw UsageError(fmt::format("{}: this is no folded sheet", verb.drawing),
                             {"suggest is for crease patterns and dielines: FOLD, SVG and DXF files"});
        return false;
    }
    in.pattern = std::move(*reading.creases);
    if (in.refinement) {
        auto joins = read_refinement(*in.refinement, in.pattern.ruler, in.of_refinement);
        if (!joins) return false;
        in.joins = std::move(*joins);
    }
    return true;
}

AcceptOptions accept_options(const Options& options) {
    return {!options.suggest.alone,
            [&compile = options.compile](const CreasePattern& refined, bool whole_way) {
                return crossings_in(refined, whole_way, compile.fold, compile.motion);
            },
            options.suggest.most_turn_deg.value_or(kMostTurnDeg)};
}

// The files that -o asks for, of the refined sheet; nullopt: something is wrong with it.
std::optional<std::vector<PendingFile>> make_outputs(const Options& options, const OutputPlan& plan,
                                                     Inputs& in, const Refined& refined, Compilation& run) {
    CompileOptions compile = options.compile;
    compile.fold.fold_angles.clear();  // the pattern says them all, and their share
    compile.fold.to = 1.0;
    CompiledDesign& one = run.designs.emplace_back();
    one.source = *in.drawing;
    one.stem = one.source.stem();
    one.diagnostics = Diagnostics(one.source.name, options.policy);
    one.creases = refined.pattern;
    one.assembly = fold_sheet(*one.creases, compile.fold, one.diagnostics);
    if (one.assembly) one.assembly->stem = one.stem;
    if (one.assembly) name_glue_flaps(refined, *one.assembly);
    if (one.assembly && moves(*one.assembly)) {
        one.motion = simulate_sheet(*one.assembly, compile.motion, one.diagnostics);
        if (!one.motion) return std::nullopt;
    }
    if (one.assembly) one.pattern = make_pattern(*one.assembly, compile.pattern, one.diagnostics);
    lay_out_run(run, compile);
    if (run.has_errors()) return std::nullopt;
    return files_of(plan, options, run);
}

// The sheet as suggestions are for it: folded by what was accepted before.
std::optional<Assembly> folded_so_far(const Options& options, const Inputs& in) {
    Diagnostics told;  // of the same sheet, once more
    FoldOptions fold = options.compile.fold;
    if (in.joins.empty()) return fold_sheet(in.pattern, fold, told);
    const auto refined = refine_shape(in.pattern, {fold, in.joins, nullptr}, told);
    if (!refined) return std::nullopt;
    fold.fold_angles.clear();  // the pattern says them all, and their share
    fold.to = 1.0;
    return fold_sheet(refined->pattern, fold, told);
}

// Pages with a picture of each suggestion; false: one could not be made, and that is told.
bool make_pages(const Options& options, const OutputPlan& plan, Inputs& in, const Suggestions& found,
                std::vector<PendingFile>& files) {
    const std::optional<Assembly> assembly = folded_so_far(options, in);
    POPUP_INVARIANT(assembly.has_value());
    SceneCard card;
    card.assembly = &*assembly;
    const bool inches = in.pattern.ruler.unit == "in";
    const book::SuggestionsOf shown{found, card, in.pattern.ruler, in.drawing->stem(), inches};
    for (const PlannedOutput& output : plan.outputs) {
        const bool is_pdf = output.path.ends_with(".pdf");
        auto bytes = is_pdf ? book::suggestions_pdf(shown, in.of_drawing)
                            : book::suggestions_html(shown, in.of_drawing);
        if (!bytes) return false;
        files.push_back({output.path, std::move(*bytes)});
    }
    return true;
}

// What is to be printed, and all files; false: something is wrong, and told.
bool work(const Options& options, const OutputPlan& plan, Inputs& in, Compilation& run, std::string& text,
          std::vector<PendingFile>& files) {
    const SuggestVerbOptions& verb = options.suggest;
    SuggestOptions suggest{options.compile.fold, in.joins, verb.near_mm, &in.of_refinement};
    Diagnostics again;  // the sheet says the same each time that it is folded
    const bool has_pages = shows_suggestions(options);
    if (!verb.accept.empty() || plan.outputs.empty() || has_pages) {
        const auto found = suggest_joins(in.pattern, suggest, in.of_drawing);
        if (!found) return false;
        if (verb.accept.empty()) {
            text = verb.json ? as_json(*found, in.pattern.ruler).dump(2) + "\n"
                             : as_text(*found, in.pattern.ruler);
            return !has_pages || make_pages(options, plan, in, *found, files);
        }
        auto joins =
            accept_joins(in.pattern, suggest, *found, verb.accept, accept_options(options), in.of_drawing);
        if (!joins) return false;
        in.joins = std::move(*joins);
    }
    const bool heard = !verb.accept.empty();
    auto refined = refine_shape(in.pattern, {options.compile.fold, in.joins, &in.of_refinement},
                                heard ? again : in.of_drawing);
    if (!refined) return false;
    if (heard) {
        for (const Diagnostic& one : again.sorted()) {
            if (one.code != "join-open" && one.code != "join-swings") continue;
            Diagnostic& told = in.of_drawing.warning(one.code, one.place, one.message);
            for (const std::string& hint : one.hints) told.hint(hint);
        }
    }
    text = as_text(in.joins, *refined, refined->enough_mm, in.pattern.ruler);
    if (heard && !verb.refinement.empty())
        files.push_back({verb.refinement, write_refinement(in.joins, in.pattern.ruler)});
    if (plan.outputs.empty()) return true;
    auto made = make_outputs(options, plan, in, *refined, run);
    if (!made) return false;
    files.insert(files.end(), std::make_move_iterator(made->begin()), std::make_move_iterator(made->end()));
    return true;
}

}  // namespace

CLI::App* add_suggest(CLI::App& app, Options& options) {
    CLI::App* verb = app.add_subcommand("suggest", "Find what of a folded carton should meet, and close it");
    SuggestVerbOptions& suggest = options.suggest;
    verb->add_option("DRAWING", suggest.drawing, "a crease pattern or dieline")
        ->required()
        ->configurable(false)
        ->type_name("");
    const std::string group = "Suggestions";
    value(*verb, "--near", "LENGTH", "look this far (default: a tenth of the sheet, 50mm at most)", group,
          [&suggest](std::string_view text) { suggest.near_mm = length_option("--near", text, 0.1).mm; });
    value(*verb, "--accept", "WHAT", "accept these, and those alike: \"merge 3, paste 1\", or all", group,
          [&suggest](std::string_view text) {
              if (text.find_first_not_of(" ,") == std::string_view::npos)
                  throw UsageError(
                      fmt::format("--accept takes suggestions or all, and \"{}\" names none", text));
              suggest.accept = text;
          })
        ->configurable(false);
    verb->add_flag("--alone", suggest.alone, "accept what is named, and not what is like it")->group(group);
    value(*verb, "--most-turn", "ANGLE",
          fmt::format("all accepts nothing that turns a fold further, degrees (default: {:g})", kMostTurnDeg),
          group, [&suggest](std::string_view text) {
              suggest.most_turn_deg = number_option("--most-turn", text, 0.01, 360.0);
          });
    value(*verb, "--refinement", "FILE", "what was accepted before; --accept writes it anew", group,
          [&suggest](std::string_view text) { suggest.refinement = text; })
        ->configurable(false);
    verb->add_flag("--json", suggest.json, "list suggestions as JSON")->configurable(false)->group(group);
    verb->add_option(
            "-o,--output", options.build.outputs,
            "write the refined sheet, by its suffix, or pictures: suggestions.html or .pdf. Repeatable")
        ->type_name("FILE")
        ->allow_extra_args(false)
        ->configurable(false)
        ->group("Output");
    add_drawing_options(*verb, options);
    add_message_options(*verb, options);
    add_policy_options(*verb, options);
    add_config_options(*verb, options);
    verb->footer(
        "Examples:\n"
        "  popupc suggest box.svg\n"
        "  popupc suggest box.svg -o suggestions.html\n"
        "  popupc suggest box.svg --accept all --refinement box.refine.json\n"
        "  popupc suggest box.svg --refinement box.refine.json -o box.glb -o box.pdf\n"
        "\nExit status 0 when it was done, 1 when the sheet cannot be folded or a suggestion is not there.");
    return verb;
}

int run_suggest(const Options& given) {
    Options options = given;
    const SuggestVerbOptions& verb = options.suggest;
    check_suggest_usage(options);
    options.inputs.names = {verb.drawing};
    if (!options.compile.read.drawing.as) options.compile.read.drawing.as = DrawnAs::folded;
    fit_layout(options.compile);
    if (options.build.outputs.empty()) keep_apart(options);
    const OutputPlan plan = options.build.outputs.empty() ? OutputPlan{} : plan_of(options);
    ReadFiles read = files_read(options, {verb.drawing});
    const bool writes = !verb.accept.empty() && !verb.refinement.empty();
    if (writes) read.spare(verb.refinement, "--refinement");
    read.add(verb.refinement, "the refinement file");
    spare(read, options);
    Inputs in;
    Compilation run;
    std::string text;
    std::vector<PendingFile> files;
    const bool usable = read_inputs(options, in);
    if (usable) allow_for_board(options.compile.fold, in);
    const bool done = usable && work(options, plan, in, run, text, files);
    bool written = true;
    for (const PendingFile& file : files) {
        if (file.path != verb.refinement) read.spare(file.path, "a further sheet");
    }
    if (done && !files.empty()) {
        clear_litter({files.front().path});
        written = write_all(files, false, in.trouble);
    }
    const bool printed = !done || !written || print(text);
    std::vector<FileFindings> findings{
        {&in.of_drawing, in.drawing ? std::string_view(in.drawing->text) : std::string_view()}};
    if (!verb.refinement.empty()) {
        findings.push_back({&in.of_refinement,
                            in.refinement ? std::string_view(in.refinement->text) : std::string_view(),
                            false});
    }
    for (const CompiledDesign& one : run.designs)
        findings.push_back({&one.diagnostics, one.source.text, false});
    findings.push_back({&run.run_diagnostics, {}, false});
    const bool told = report(options.messages, findings, in.trouble);
    if (!in.usable || !written || !printed || !told) return exit_unusable;
    return done ? exit_done : exit_findings;
}

}  // namespace popup::cli
