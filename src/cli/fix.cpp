#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <system_error>

#include "cli/files/inputs.h"
#include "cli/files/line_diff.h"
#include "cli/files/outputs.h"
#include "cli/files/read_files.h"
#include "cli/options/program_options.h"
#include "cli/report.h"
#include "cli/verbs.h"
#include "popup/files.h"
#include "repair/free_collisions.h"
#include "repair/mend_document.h"

namespace popup::cli {
namespace {

void check_usage(const Options& options, const InputFiles& files) {
    const std::vector<std::string>& inputs = options.inputs.names;
    const FixOptions& fix = options.fix;
    if (fix.in_place) {
        for (const std::string& name : inputs) {
            if (name == "-") throw UsageError("standard input cannot be mended in place", {"use -o FILE"});
        }
        for (std::size_t i = 0; i < inputs.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                if (same_place(inputs[i], inputs[j])) throw UsageError(inputs[i] + " is named twice");
            }
        }
        return;
    }
    const bool to_standard_output = fix.diff || fix.output.empty() || fix.output == "-";
    if (to_standard_output && options.messages.use_standard_output()) {
        throw UsageError("standard output has two users: the document and the diagnostics",
                         {"--diagnostics FILE and -o FILE take files"});
    }
    if (!options.messages.file.empty() && same_place(options.messages.file, fix.output)) {
        throw UsageError(fix.output + " is named twice as an output");
    }
    if (!fix.diff && files.names.size() > 1) {
        throw UsageError("several inputs make several documents", {"use --in-place or --diff"});
    }
}

// A drawing that is read as a card becomes a document.
bool becomes_document(const Options& options, const Language& language) {
    return language.drawn && options.compile.read.drawing.as == DrawnAs::card;
}

// Only documents have repairs that can be written back.
void check_language(const Options& options, const Language& language, const std::string& name) {
    if (language.patch != nullptr) return;
    if (becomes_document(options, language)) {
        if (!options.fix.in_place && !options.fix.diff) return;
        throw UsageError(fmt::format("{}: of a drawing a document is made, which does not replace it", name),
                         {"name the document with -o, such as -o card.xml"});
    }
    throw UsageError(
        fmt::format("{}: fix mends popup documents, and this {}", name, what_it_is(language)),
        language.drawn ? std::vector<std::string>{"--as card reads it as a pop-up card, and makes a document "
                                                  "of it"}
                       : std::vector<std::string>{"popupc check tells what is wrong with it; popupc build "
                                                  "writes its sheets"});
}

// As far as names tell: no program is run that could not be mended.
void check_documents(const Options& options, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        if (name == "-" && options.inputs.language.empty()) continue;
        const Language* language = find_language({name, {}}, options.inputs.language);
        std::error_code error;
        const bool there = name == "-" || std::filesystem::exists(name, error);
        if (language != nullptr && there) check_language(options, *language, name);
    }
}

// The document with its repairs. Adds a finding and returns nullopt if the repairs do not come to an end, or
// if a document cannot tell the card.
std::optional<std::string> mended(const Options& options, CompiledDesign& one) {
    if (!one.design) {
        one.diagnostics
            .error("no-document", {}, "no document can be written of this card: it is not made of elements")
            .hint("popupc build writes sheets and models of the drawing itself");
        return std::nullopt;
    }
    auto text = mended_document(one, language_of(options.inputs, one.source), options.compile);
    if (text) return text;
    one.diagnostics.error("fix-unsettled", {}, "the repairs do not settle: mending one thing breaks another")
        .hint("mend what the first warnings name by hand, then run fix again");
    return std::nullopt;
}

// The document with what collides moved apart; adds to `left` how many pairs are not.
std::string freed(const Options& options, CompiledDesign& one, std::string text, std::size_t& left) {
    const Language* language = &language_of(options.inputs, one.source);
    if (becomes_document(options, *language)) language = find_language({}, "xml");
    const FreedDocument made =
        free_collisions({one.source.name, std::move(text)}, *language, options.compile, options.policy);
    left += made.left.size();
    one.diagnostics = with_moves(one.diagnostics, *one.design, made);
    return made.text;
}

std::vector<std::string> names_of(const std::vector<PendingFile>& files) {
    std::vector<std::string> names;
    names.reserve(files.size());
    for (const PendingFile& file : files) names.push_back(file.path);
    return names;
}

}  // namespace

CLI::App* add_fix(CLI::App& app, Options& options) {
    CLI::App* verb = app.add_subcommand("fix", "Write the repaired document; comments and layout stay");
    FixOptions& fix = options.fix;
    add_input_options(*verb, options);
    add_tree_options(*verb, options);
    add_document_output_options(*verb, fix, "write each document over its input");
    verb->add_flag("--drop", options.compile.check.drop,
                   "take out elements that are too small to make, and what stands on them")
        ->group("Output");
    verb->add_flag("--collisions", fix.collisions,
                   "move elements as little as parts those that collide or lie on others")
        ->group("Output");
    add_message_options(*verb, options);
    add_config_options(*verb, options);
    add_thread_option(*verb, options);
    verb->footer(
        "Examples:\n"
        "  popupc fix --diff castle.xml\n"
        "  popupc fix --in-place designs/\n"
        "  popupc fix castle.xml -o castle-fixed.xml\n"
        "  popupc fix --collisions --diff castle.xml\n"
        "  popupc fix --as card drawing.svg -o card.xml\n"
        "\nExit status 0 when what was written is right; 1 when something could not be repaired (nothing is\n"
        "written), when --collisions leaves some that no comment allows (what helps is written), or,\n"
        "with --diff, when there is something to change.");
    return verb;
}

int run_fix(const Options& options) {
    InputFiles files = find_inputs(options, Walked::documents);
    check_usage(options, files);
    spare(files_read(options, files.names, files.ignore_files), options);
    check_documents(options, files.names);
    check_document_name(options.fix.output, "fix");
    Run run = run_inputs(options, std::move(files), Stage::motion);
    check_loaded(run, options.fix.output);
    check_loaded(run, options.messages.file);
    Compilation& compilation = run.compilation;
    for (const CompiledDesign& one : compilation.designs) {
        check_language(options, language_of(options.inputs, one.source), one.source.name);
    }
    bool written = true;
    bool changed = false;
    std::size_t colliding = 0;  // pairs that are left
    if (run.usable() && !compilation.has_errors()) {
        std::string diff;
        std::vector<PendingFile> documents;
        for (CompiledDesign& one : compilation.designs) {
            std::optional<std::string> text = mended(options, one);
            if (!text) continue;
            if (options.fix.collisions) text = freed(options, one, std::move(*text), colliding);
            if (*text != one.source.text) changed = true;
            if (options.fix.diff) {
                diff += unified_diff(one.source.name, one.source.text, *text);
            } else if (options.fix.in_place) {
                if (*text != one.source.text) announce_links(options.messages, one.source.name);
                documents.push_back({one.source.name, std::move(*text)});
            } else {
                documents.push_back(
                    {options.fix.output.empty() ? "-" : options.fix.output, std::move(*text)});
            }
        }
        if (options.fix.diff && !diff.empty()) documents.push_back({"-", std::move(diff)});
        if (!compilation.has_errors()) {
            clear_litter(names_of(documents));
            written = write_all(documents, options.fix.in_place, compilation.run_diagnostics);
        }
    }
    if (!written && reader_has_gone()) return exit_unusable;
    const bool told = report(options.messages, run.findings(), compilation.run_diagnostics);
    if (!run.usable() || !written || !told) return exit_unusable;
    return compilation.has_errors() || colliding > 0 || (options.fix.diff && changed) ? exit_findings
                                                                                      : exit_done;
}

}  // namespace popup::cli
