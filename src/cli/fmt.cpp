#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/files/inputs.h"
#include "cli/files/line_diff.h"
#include "cli/files/outputs.h"
#include "cli/files/read_files.h"
#include "cli/options/program_options.h"
#include "cli/report.h"
#include "cli/verbs.h"
#include "popup/edit.h"
#include "popup/files.h"

namespace popup::cli {
namespace {

void check_fmt_usage(const Options& options) {
    const FmtVerbOptions& verb = options.fmt;
    const FixOptions& output = verb.output;
    const bool to_standard_output =
        !output.in_place && (output.diff || output.output.empty() || is_standard_output(output.output));
    if (output.in_place &&
        std::find(verb.documents.begin(), verb.documents.end(), "-") != verb.documents.end())
        throw UsageError("standard input cannot be written in place", {"use -o FILE"});
    if (!output.in_place && !output.diff && verb.documents.size() > 1)
        throw UsageError("several documents go to several files", {"use --in-place or --diff"});
    check_document_name(output.output, "fmt");
    if (to_standard_output && options.messages.use_standard_output()) {
        throw UsageError("standard output has two users: the document and the diagnostics",
                         {"--diagnostics FILE and -o FILE take files"});
    }
}

}  // namespace

CLI::App* add_fmt(CLI::App& app, Options& options) {
    CLI::App* verb = app.add_subcommand("fmt", "Write documents in their canonical spelling; comments stay");
    FmtVerbOptions& fmt = options.fmt;
    verb->add_option("DOCUMENT", fmt.documents, "popup documents; \"-\" is standard input")
        ->required()
        ->configurable(false)
        ->type_name("");
    add_document_output_options(*verb, fmt.output, "write each document over its input");
    add_message_options(*verb, options);
    add_policy_options(*verb, options);
    add_config_options(*verb, options);
    verb->footer(
        "Examples:\n"
        "  popupc fmt --in-place card.xml\n"
        "  popupc fmt --diff designs/*.xml\n"
        "\nWhat a document means stays as it is, and so do its comments; nothing is repaired. A document "
        "with\n"
        "something in it that has no meaning is left alone, because that would be lost.\n"
        "Exit status 0 when the documents were written; 1 when one of them cannot be read as a design (then\n"
        "nothing is written), or, with --diff, when there is something to change.");
    return verb;
}

int run_fmt(const Options& options) {
    check_fmt_usage(options);
    const FmtVerbOptions& verb = options.fmt;
    const ReadFiles read = files_read(options, verb.documents);
    read.spare(verb.output.output, "-o", kInPlaceHint);
    read.spare(options.messages.file, "--diagnostics");
    Diagnostics trouble;
    std::vector<Source> sources;
    std::vector<Diagnostics> findings;
    std::vector<PendingFile> files;
    std::string diff;
    bool ok = true;
    bool changed = false;
    for (const std::string& name : verb.documents) {
        auto source = read_source(name, trouble);
        if (!source) continue;
        check_is_document(*source, options.compile.read, "fmt spells popup documents");
        check_loaded(*source, options.compile.read, {verb.output.output, options.messages.file});
        sources.push_back(std::move(*source));
    }
    const bool readable = sources.size() == verb.documents.size();
    findings.reserve(sources.size());
    for (const Source& source : sources) {
        const auto text = format_document(source, findings.emplace_back(source.name, options.policy));
        if (!text) {
            ok = false;
            continue;
        }
        if (*text == source.text && (verb.output.in_place || verb.output.diff)) continue;
        changed = changed || *text != source.text;
        if (verb.output.diff) {
            diff += unified_diff(source.name, source.text, *text);
        } else if (verb.output.in_place) {
            announce_links(options.messages, source.name);
            files.push_back({source.name, *text});
        } else {
            files.push_back({verb.output.output.empty() ? "-" : verb.output.output, *text});
        }
    }
    if (!diff.empty()) files.push_back({"-", std::move(diff)});
    bool written = true;
    if (ok && readable && !files.empty()) {
        clear_litter({files.front().path});
        written = write_all(files, verb.output.in_place, trouble);
    }
    if (!written && reader_has_gone()) return exit_unusable;
    std::vector<FileFindings> told;
    for (std::size_t i = 0; i < sources.size(); ++i) told.push_back({&findings[i], sources[i].text});
    if (!report(options.messages, told, trouble) || !readable || !written) return exit_unusable;
    return !ok || (verb.output.diff && changed) ? exit_findings : exit_done;
}

}  // namespace popup::cli
