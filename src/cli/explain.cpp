#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "cli/report.h"
#include "cli/verbs.h"

namespace popup::cli {
namespace {

constexpr std::size_t kWidth = 80;

std::string wrapped(std::string_view paragraph) {
    std::string text;
    std::size_t column = 0;
    while (!paragraph.empty()) {
        const std::size_t end = std::min(paragraph.find(' '), paragraph.size());
        const std::string_view word = paragraph.substr(0, end);
        paragraph.remove_prefix(std::min(end + 1, paragraph.size()));
        if (word.empty()) continue;
        if (column > 0 && column + 1 + word.size() > kWidth) {
            text += '\n';
            column = 0;
        } else if (column > 0) {
            text += ' ';
            ++column;
        }
        text += word;
        column += word.size();
    }
    return text + "\n";
}

const CodeInfo& code_named(std::string_view code) {
    // As it stands in the message.
    if (code.starts_with('[') && code.ends_with(']')) code = code.substr(1, code.size() - 2);
    if (const CodeInfo* row = find_code(code)) return *row;
    std::vector<std::string_view> known;
    for (const CodeInfo& info : code_table()) known.push_back(info.code);
    auto hints = did_you_mean(code, known);
    hints.emplace_back("\"popupc list codes\" lists all");
    throw UsageError(fmt::format("there is no diagnostic \"{}\"", code), hints, known);
}

}  // namespace

CLI::App* add_explain(CLI::App& app, Options& options) {
    CLI::App* verb = app.add_subcommand("explain", "What a diagnostic means and what mends it");
    verb->add_option_function<std::string>(
            "CODE", [&options](const std::string& text) { options.topic = code_named(text).code; },
            "the word in brackets at the end of a diagnostic")
        ->required()
        ->type_name("");
    verb->footer(
        "Examples:\n"
        "  popupc explain unreadable-input\n"
        "\n\"popupc list codes\" lists all codes.");
    return verb;
}

int run_explain(const Options& options) {
    const CodeInfo& row = code_named(options.topic);
    const std::string text = fmt::format("{} ({}): {}\n\n{}", row.code, to_string(row.severity), row.summary,
                                         wrapped(row.explanation));
    return print(text) ? exit_done : exit_unusable;
}

}  // namespace popup::cli
