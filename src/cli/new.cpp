#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/files/outputs.h"
#include "cli/options/value_option.h"
#include "cli/report.h"
#include "cli/verbs.h"
#include "popup/compile.h"
#include "popup/edit.h"
#include "popup/files.h"

namespace popup::cli {
namespace {

// "200x140", "8x5in".
void read_card_size(std::string_view text, NewVerbOptions& made) {
    const std::size_t cross = text.find('x');
    std::string_view unit;
    std::string_view number = text;
    while (!number.empty() && (number.back() < '0' || number.back() > '9') && number.back() != '.')
        number.remove_suffix(1);
    unit = text.substr(number.size());
    if (cross != std::string_view::npos && cross < number.size()) {
        const auto width = parse_length(std::string(text.substr(0, cross)) + std::string(unit));
        const auto height = parse_length(std::string(number.substr(cross + 1)) + std::string(unit));
        if (width && height && width->mm >= 10.0 && height->mm >= 10.0 && width->mm <= 5000.0 &&
            height->mm <= 5000.0) {
            made.size = {width->mm, height->mm};
            made.unit = unit;
            return;
        }
    }
    throw UsageError(
        fmt::format("--size takes the width and height of the open card, from 10 mm to 5 m each, not \"{}\"",
                    text),
        {"write 200x140mm or 8x6in"});
}

std::vector<std::string> words(std::string_view text) {
    std::vector<std::string> made;
    while (!text.empty()) {
        const std::size_t comma = std::min(text.find(','), text.size());
        made.emplace_back(text.substr(0, comma));
        text.remove_prefix(std::min(comma + 1, text.size()));
    }
    return made;
}

}  // namespace

CLI::App* add_new(CLI::App& app, Options& options) {
    CLI::App* verb =
        app.add_subcommand("new", "Begin a document: an empty card, some elements, or a template");
    NewVerbOptions& made = options.made;
    verb->add_option("DOCUMENT", made.output, "the file to write; \"-\" is standard output")
        ->required()
        ->configurable(false)
        ->type_name("");
    value(*verb, "--size", "SIZE",
          "width and height of the open card, such as 8x6in, and the document's unit (default 200x140mm, or "
          "the template's)",
          "Card", [&made](std::string_view text) { read_card_size(text, made); })
        // A size in a configuration is that of pictures.
        ->configurable(false);
    CLI::Option* with = value(*verb, "--with", "TYPES", "elements along the gutter, such as v-fold,tent",
                              "Card", [&made](std::string_view text) { made.with = words(text); })
                            ->configurable(false);
    CLI::Option* pattern =
        value(*verb, "--template", "NAME", "a card that is worth printing as it comes; popupc list templates",
              "Card",
              [&made](std::string_view text) {
                  std::vector<std::string_view> names;
                  for (const CardTemplate& one : card_templates()) names.push_back(one.name);
                  if (std::find(names.begin(), names.end(), text) == names.end()) {
                      throw UsageError(fmt::format("there is no template \"{}\"", text),
                                       {fmt::format("templates: {}", fmt::join(names, " "))}, names);
                  }
                  made.pattern = text;
              })
            ->configurable(false);
    with->excludes(pattern);
    verb->add_flag("--force", made.force, "write over a file that is there")
        ->configurable(false)
        ->group("Output");
    add_message_options(*verb, options);
    add_policy_options(*verb, options);
    add_config_options(*verb, options);
    verb->footer(
        "Examples:\n"
        "  popupc new card.xml\n"
        "  popupc new card.xml --size 8x6in --with v-fold,tent\n"
        "  popupc new birthday.xml --template birthday\n"
        "\nExit status 0 when the document was written, 1 when the elements have no room, 2 for wrong usage\n"
        "and when the file is there already or cannot be written.");
    return verb;
}

int run_new(const Options& options) {
    const NewVerbOptions& verb = options.made;
    if (verb.output == "-" && options.messages.use_standard_output()) {
        throw UsageError("standard output has two users: the document and the diagnostics",
                         {"--diagnostics FILE takes a file"});
    }
    check_document_name(verb.output, "new");
    std::error_code error;
    if (!verb.force && verb.output != "-" && !is_standard_output(verb.output) &&
        std::filesystem::exists(verb.output, error)) {
        throw UsageError(fmt::format("{} is there already", verb.output),
                         {"--force writes over it", "popupc edit changes it"});
    }
    NewCard wanted;
    if (verb.size) {
        wanted.width_mm = verb.size->first;
        wanted.height_mm = verb.size->second;
        wanted.unit = verb.unit;
    }
    wanted.with = verb.with;
    wanted.pattern = verb.pattern;
    Diagnostics findings(verb.output, options.policy);
    Diagnostics trouble;
    const auto text = new_document(wanted, findings);
    bool written = true;
    if (text) {
        clear_litter({verb.output});
        written = write_all({{verb.output, *text}}, false, trouble);
    }
    if (!written && reader_has_gone()) return exit_unusable;
    // Elements that have just room are made; what is found of them with the usual settings is said here.
    Compilation made;
    if (text) {
        CompileOptions compile_options = options.compile;
        compile_options.until = Stage::pattern;
        compile_options.read.language = "xml";
        const std::string name = verb.output == "-" ? "standard output" : verb.output;
        made = compile({{name, *text}}, compile_options, options.policy);
    }
    const Diagnostics& found = text ? made.designs.front().diagnostics : findings;
    const bool told = report(options.messages, {{&found, text.value_or("")}}, trouble);
    if (!written || !told) return exit_unusable;
    return text ? exit_done : exit_findings;
}

}  // namespace popup::cli
