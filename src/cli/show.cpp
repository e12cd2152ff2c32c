#include <CLI/CLI.hpp>

#include "cli/files/outputs.h"
#include "cli/files/read_files.h"
#include "cli/options/program_options.h"
#include "cli/report.h"
#include "cli/verbs.h"
#include "popup/edit.h"
#include "popup/edit_drawing.h"
#include "popup/files.h"

namespace popup::cli {
namespace {

// The vertices and edges of a folded sheet.
std::optional<std::string> show_sheet_of(const Source& source, const Options& options, Diagnostics& trouble,
                                         Diagnostics& findings) {
    const ShowVerbOptions& verb = options.show;
    DrawingEditOptions drawing{
        options.compile.read, options.compile.fold, {}, options.compile.motion, {}, false};
    if (!verb.refinement.empty()) {
        const auto refinement = read_source(verb.refinement, trouble);
        if (!refinement) return std::nullopt;
        drawing.read.drawing.as = DrawnAs::folded;
        Diagnostics unheard(source.name);
        const Reading reading = read_source_text(source, drawing.read, unheard);
        if (reading.creases) {
            auto joins = read_refinement(*refinement, reading.creases->ruler, findings);
            if (!joins) return std::nullopt;
            drawing.joins = std::move(*joins);
        }
    }
    return show_drawing(source, drawing, verb.json, findings);
}

}  // namespace

CLI::App* add_show(CLI::App& app, Options& options) {
    CLI::App* verb =
        app.add_subcommand("show", "Show the elements of a document: sizes, folds, what stands on what");
    ShowVerbOptions& show = options.show;
    verb->add_option("DOCUMENT", show.document, "a document, program or drawing; \"-\" is standard input")
        ->required()
        ->configurable(false)
        ->type_name("");
    verb->add_option("ID", show.id, "one element alone, and what stands on it")
        ->check([](const std::string& id) {
            if (id.empty()) throw UsageError("the element to show has an empty name");
            return std::string();
        })
        ->configurable(false)
        ->type_name("");
    verb->add_flag("--all", show.all, "measures that go without saying, colours and defaults, too")
        ->group("Output");
    verb->add_flag("--json", show.json, "as JSON, with all measures, points and values")
        ->configurable(false)
        ->group("Output");
    verb->add_option("--refinement", show.refinement, "what popupc suggest accepted of a drawing")
        ->type_name("FILE")
        ->configurable(false)
        ->group("Input");
    add_program_options(*verb, options);
    verb->remove_option(verb->get_option("--print"));
    add_drawing_options(*verb, options);
    // The sheet is as it is drawn.
    for (const char* const other : {"--board", "--flat"}) verb->remove_option(verb->get_option(other));
    add_message_options(*verb, options);
    add_policy_options(*verb, options);
    add_config_options(*verb, options);
    verb->footer(
        "Examples:\n"
        "  popupc show card.xml\n"
        "  popupc show card.xml bird --all\n"
        "  popupc show card.xml --json\n"
        "  popupc show box.svg\n"
        "\nLengths are in the document's unit. Exit status 0 when it was shown, 1 when the document cannot "
        "be\n"
        "understood or has no such element.");
    return verb;
}

int run_show(const Options& options) {
    const ShowVerbOptions& verb = options.show;
    if (options.messages.use_standard_output()) {
        throw UsageError("standard output has two users: the elements and the diagnostics",
                         {"--diagnostics FILE takes a file"});
    }
    files_read(options, {verb.document}).spare(options.messages.file, "--diagnostics");
    Diagnostics trouble;
    Diagnostics findings(verb.document, options.policy);
    const auto source = read_source(verb.document, trouble);
    std::optional<std::string> shown;
    if (source) {
        check_loaded(*source, options.compile.read, {options.messages.file});
        if (is_sheet_drawing(*source, options.compile.read)) {
            shown = show_sheet_of(*source, options, trouble, findings);
        } else if (const auto design = read_design(*source, options.compile.read, findings)) {
            ShowOptions show;
            show.id = verb.id;
            show.all = verb.all;
            shown = verb.json ? show_json(*design, show, findings) : show_tree(*design, show, findings);
        }
    }
    const bool printed = !shown || print(*shown);
    const bool told = report(options.messages, {{&findings, source ? source->text : std::string()}}, trouble);
    if (!source || !printed || !told) return exit_unusable;
    return shown ? exit_done : exit_findings;
}

}  // namespace popup::cli
