#include "popup/edit.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "cli/files/inputs.h"
#include "cli/files/line_diff.h"
#include "cli/files/outputs.h"
#include "cli/files/read_files.h"
#include "cli/options/program_options.h"
#include "cli/report.h"
#include "cli/verbs.h"
#include "popup/edit_drawing.h"
#include "popup/files.h"
#include "popup/refinement.h"

namespace popup::cli {
namespace {

// Of documents with up to so many elements all is looked at as `check` does, where nothing asks for it: that
// takes some ten milliseconds.
constexpr std::size_t kMostExamined = 40;

std::string edits_footer() {
    std::string text = "Edits, with lengths in the document's unit where they have none of their own:\n";
    for (const EditVerb& verb : edit_verbs())
        text += fmt::format("  {} {}\n      {}\n", verb.name, verb.usage, verb.about);
    text +=
        "\nEdits of drawings of folded sheets, in space, with lengths in mm; popupc show lists their "
        "names:\n";
    for (const EditVerb& verb : sheet_edit_verbs())
        text += fmt::format("  {} {}\n      {}\n", verb.name, verb.usage, verb.about);
    return text +
           "\nExamples:\n"
           "  popupc edit card.xml add v-fold --id bird --on gutter --at 20 --width 40 --height 35 "
           "--in-place\n"
           "  popupc edit card.xml set bird --angle 70 --left-color '#5b8c5a' --diff\n"
           "  popupc edit card.xml move bird --along 12 --follow -o moved.xml\n"
           "  popupc edit card.xml -f edits.txt --in-place\n"
           "  popupc edit box.svg extrude top --by 10mm -o higher.svg\n"
           "  popupc edit box.svg edge front+top --by 0,0,5 --diff\n"
           "\nedit tells what the change brings that popupc check would find. An error refuses it, also one "
           "that\n--deny or --werror makes. In documents of more than 40 elements edit looks for collisions, "
           "parts\nthat stick out and small tabs only with --deny or --werror.\n"
           "\nExit status 0 when the edit was carried out; 1 when it was refused (nothing is written), or, "
           "with\n"
           "--diff, when it changes something; 2 for wrong usage and files that cannot be read or written.";
}

void check_edit_usage(const EditVerbOptions& edit, const MessageOptions& messages) {
    if (edit.file.empty() == edit.words.empty()) {
        throw UsageError(
            edit.words.empty() ? "no edit is given" : "edits come from the command line or from -f",
            {"such as: popupc edit card.xml set bird --angle 70"});
    }
    if (edit.output.in_place && edit.document == "-")
        throw UsageError("standard input cannot be edited in place", {"use -o FILE"});
    if (edit.file == "-" && edit.document == "-")
        throw UsageError("standard input cannot be both the document and the edits");
    const bool to_standard_output =
        !edit.output.in_place &&
        (edit.output.diff || edit.output.output.empty() || is_standard_output(edit.output.output));
    if (to_standard_output && messages.use_standard_output()) {
        throw UsageError("standard output has two users: the document and the diagnostics",
                         {"--diagnostics FILE and -o FILE take files"});
    }
    if (!messages.file.empty() && (same_place(messages.file, edit.output.output) ||
                                   (edit.output.in_place && same_place(messages.file, edit.document))))
        throw UsageError(messages.file + " is named twice as an output");
}

// Whether more than the checks is looked at. Opening tags are counted in place of elements: they are all that
// a document can have.
bool is_examined(const Source& source, const Options& options) {
    if (!options.policy.deny.empty() || options.policy.warnings_are_errors) return true;
    constexpr std::string_view kTag = "<structure ";
    std::size_t count = 0;
    for (std::size_t at = source.text.find(kTag); at != std::string::npos && count <= kMostExamined;
         at = source.text.find(kTag, at + kTag.size()))
        ++count;
    return count <= kMostExamined;
}

// What an edit reads.
struct EditInputs {
    std::optional<Source> document;
    bool is_sheet = false;  // the document is a drawing of a folded sheet
    std::string edits_text;
    std::vector<EditLine> edits;
    std::optional<Source> refinement;
    std::vector<Join> joins;  // of the refinement, on sheets
    Ruler ruler;              // of the drawing, in which their corners are
    bool readable = true;     // all files could be read
};

void read_edits_of(const EditVerbOptions& verb, EditInputs& in, Diagnostics& of_edits, Diagnostics& trouble) {
    if (verb.file.empty()) {
        in.edits.push_back({verb.words, {}});
        return;
    }
    const auto file = read_source(verb.file, trouble);
    in.readable = in.readable && file.has_value();
    if (!file) return;
    in.edits_text = file->text;
    in.edits = read_edits(in.edits_text, of_edits);
}

// Corners in the refinement are as the drawing's ruler shows them.
void read_joins_of(const Options& options, EditInputs& in, Diagnostics& of_refinement, Diagnostics& trouble) {
    in.refinement = read_source(options.edit.refinement, trouble);
    in.readable = in.readable && in.refinement.has_value();
    if (!in.refinement) return;
    ReadOptions as_sheet = options.compile.read;
    as_sheet.drawing.as = DrawnAs::folded;
    Diagnostics unheard(in.document->name);
    const Reading reading = read_source_text(*in.document, as_sheet, unheard);
    if (!reading.creases) return;
    in.ruler = reading.creases->ruler;
    auto joins = read_refinement(*in.refinement, in.ruler, of_refinement);
    if (joins) in.joins = std::move(*joins);
}

// The drawings that edits read, which are not what comes out of them.
void add_drawings(const std::vector<EditLine>& edits, ReadFiles& read) {
    constexpr std::string_view kFrom = "--from";
    for (const EditLine& line : edits) {
        for (std::size_t i = 0; i < line.words.size(); ++i) {
            const std::string& word = line.words[i];
            if (word == kFrom && i + 1 < line.words.size()) read.add(line.words[i + 1], "a drawing");
            if (word.starts_with("--from=")) read.add(word.substr(kFrom.size() + 1), "a drawing");
        }
    }
}

// Carries the edits out. The joins, and their ruler, are those of the edited drawing then.
std::optional<Edited> edited_by(const Options& options, EditInputs& in, Diagnostics& heard,
                                Diagnostics& of_document) {
    if (in.is_sheet) {
        DrawingEditOptions drawing{
            options.compile.read, options.compile.fold, std::move(in.joins), options.compile.motion, in.ruler,
            options.edit.force};
        drawing.all = &options.compile;
        auto edited = edit_drawing(*in.document, in.edits, drawing, heard, of_document);
        in.joins = std::move(drawing.joins);
        in.ruler = drawing.ruler;
        return edited;
    }
    EditOptions edit;
    edit.force = options.edit.force;
    edit.read = options.compile.read;
    if (is_examined(*in.document, options)) edit.all = &options.compile;
    return edit_document(*in.document, in.edits, edit, heard, of_document);
}

// What is to be written of an edit that was not refused.
std::vector<PendingFile> files_of(const Options& options, const EditInputs& in, const std::string& text) {
    const FixOptions& output = options.edit.output;
    const bool changed = text != in.document->text;
    if (output.diff) {
        if (!changed) return {};
        return {{"-", unified_diff(in.document->name, in.document->text, text)}};
    }
    if (!output.in_place) return {{output.output.empty() ? "-" : output.output, text}};
    if (changed) announce_links(options.messages, options.edit.document);
    std::vector<PendingFile> files{{options.edit.document, text}};
    // Corners that a refinement names by their places go with the drawing.
    if (in.refinement) files.push_back({options.edit.refinement, write_refinement(in.joins, in.ruler)});
    return files;
}

}  // namespace

CLI::App* add_edit(CLI::App& app, Options& options) {
    CLI::App* verb =
        app.add_subcommand("edit", "Edit a document by command; what is not touched stays as it is");
    EditVerbOptions& edit = options.edit;
    verb->add_option("DOCUMENT", edit.document,
                     "the popup document or drawing; \"-\" is standard input; behind it the edit")
        ->required()
        ->configurable(false)
        ->type_name("");
    verb->allow_extras();
    verb->add_option("-f,--file", edit.file, "carry out the edits of a file, one a line, all of them or none")
        ->type_name("FILE")
        ->configurable(false)
        ->group("Input");
    add_document_output_options(*verb, edit.output, "write the document over its input");
    verb->add_flag("--force", edit.force, "carry it out also where the card has a new error then")
        ->configurable(false)
        ->group("Output");
    verb->add_option("--refinement", edit.refinement,
                     "what popupc suggest accepted of a drawing; --in-place writes it anew")
        ->type_name("FILE")
        ->configurable(false)
        ->group("Input");
    add_drawing_options(*verb, options);
    // The sheet is as it is drawn.
    for (const char* const other : {"--board", "--flat"}) verb->remove_option(verb->get_option(other));
    add_message_options(*verb, options);
    add_policy_options(*verb, options);
    add_config_options(*verb, options);
    verb->footer(edits_footer());
    return verb;
}

int run_edit(const Options& options) {
    const EditVerbOptions& verb = options.edit;
    check_edit_usage(verb, options.messages);
    ReadFiles read = files_read(options, {verb.document});
    read.add(verb.file, "which edits are read from");
    read.add(verb.refinement, "the refinement file");
    const auto spare_inputs = [&] {
        read.spare(verb.output.output, "-o", verb.refinement.empty() ? kInPlaceHint : kAnotherFileHint);
        read.spare(options.messages.file, "--diagnostics");
    };
    spare_inputs();
    Diagnostics trouble;
    Diagnostics of_edits(verb.file);
    Diagnostics of_document(verb.document, options.policy);
    Diagnostics of_refinement(verb.refinement, options.policy);
    EditInputs in;
    in.document = read_source(verb.document, trouble);
    in.readable = in.document.has_value();
    read_edits_of(verb, in, of_edits, trouble);
    add_drawings(in.edits, read);
    spare_inputs();
    in.is_sheet = in.document && is_sheet_drawing(*in.document, options.compile.read);
    if (in.document && !in.is_sheet) {
        check_is_document(*in.document, options.compile.read,
                          "edit changes popup documents, and SVG drawings of folded sheets");
        check_document_name(verb.output.output, "edit");
    }
    if (in.is_sheet && !verb.refinement.empty()) read_joins_of(options, in, of_refinement, trouble);
    std::optional<Edited> edited;
    if (in.readable && !of_edits.has_errors() && !of_refinement.has_errors())
        edited = edited_by(options, in, verb.file.empty() ? of_document : of_edits, of_document);
    if (edited) {
        check_loaded(edited->files, {verb.output.output, options.messages.file});
    } else if (in.document) {
        check_loaded(*in.document, options.compile.read, {options.messages.file});
    }
    const bool accepted = edited && !edited->refused;
    const bool changed = accepted && edited->text != in.document->text;
    if (changed && !in.is_sheet && !edited->examined) {
        of_document
            .remark("edit-not-examined", {},
                    fmt::format("the document has more than {} elements, so that collisions, what sticks out "
                                "and tabs were not looked at",
                                kMostExamined))
            .hint("popupc check looks at them; so does edit with --deny or --werror");
    }
    bool written = true;
    if (accepted) {
        const std::vector<PendingFile> files = files_of(options, in, edited->text);
        if (!files.empty()) {
            clear_litter({files.front().path});
            written = write_all(files, verb.output.in_place, trouble);
        }
    }
    if (!written && reader_has_gone()) return exit_unusable;
    const std::string text = edited ? edited->text : in.document ? in.document->text : std::string();
    std::vector<FileFindings> findings;
    if (!of_edits.sorted().empty()) findings.push_back({&of_edits, in.edits_text, false});
    if (findings.empty() || !of_document.sorted().empty()) findings.push_back({&of_document, text});
    if (in.refinement && !of_refinement.sorted().empty())
        findings.push_back({&of_refinement, in.refinement->text, false});
    const bool told = report(options.messages, findings, trouble);
    if (!in.readable || !written || !told) return exit_unusable;
    return !accepted || (verb.output.diff && changed) ? exit_findings : exit_done;
}

}  // namespace popup::cli
