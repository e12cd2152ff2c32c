#include "cli/inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace popup::cli {
namespace {

bool ends_with_suffix(std::string_view name, std::string_view suffix) {
    if (suffix.empty() || name.size() < suffix.size()) return false;
    return std::equal(suffix.begin(), suffix.end(), name.end() - static_cast<std::ptrdiff_t>(suffix.size()),
                      [](char a, char b) {
                          return std::tolower(static_cast<unsigned char>(a)) ==
                                 std::tolower(static_cast<unsigned char>(b));
                      });
}

}  // namespace

std::vector<FileFindings> Run::findings() const {
    std::vector<FileFindings> all;
    all.reserve(order.size());
    for (const int index : order) {
        if (index < 0) {
            all.push_back({&unreadable[static_cast<std::size_t>(-1 - index)], {}});
        } else {
            const CompiledDesign& one = compilation.designs[static_cast<std::size_t>(index)];
            all.push_back({&one.diagnostics, one.source.text});
        }
    }
    return all;
}

const Language& language_of(const InputOptions& options, const std::string& name) {
    const std::vector<Language>& table = language_table();
    for (const Language& row : table) {
        const bool meant =
            options.language.empty() ? ends_with_suffix(name, row.suffix) : row.name == options.language;
        if (meant) return row;
    }
    // Standard input has no suffix; as long as there is one language it cannot be another.
    if (name == "-" && table.size() == 1) return table.front();
    std::string known;
    for (const Language& row : table)
        known += fmt::format("{}{} ({})", known.empty() ? "" : ", ", row.name, row.suffix);
    if (name == "-")
        throw UsageError("the language of standard input is not known", {"name it with --from: " + known});
    throw UsageError(fmt::format("{}: the suffix names no language", name),
                     {"languages: " + known, "--from LANGUAGE says what the file holds"});
}

Run run_inputs(const Options& options, Stage until) {
    const std::vector<std::string>& names = options.inputs.names;
    if (std::count(names.begin(), names.end(), "-") > 1) {
        throw UsageError("standard input can be read only once");
    }
    Run run;
    std::vector<Source> sources;
    for (const std::string& name : names) {
        Diagnostics diagnostics(name);
        std::optional<Source> source = read_source(name, diagnostics);
        if (source) {
            language_of(options.inputs, name);
            run.order.push_back(static_cast<int>(sources.size()));
            sources.push_back(std::move(*source));
        } else {
            run.order.push_back(-1 - static_cast<int>(run.unreadable.size()));
            run.unreadable.push_back(std::move(diagnostics));
        }
    }
    CompileOptions compile_options = options.compile;
    compile_options.read.language = options.inputs.language;
    if (compile_options.read.language.empty() && language_table().size() == 1) {
        compile_options.read.language = language_table().front().name;
    }
    compile_options.until = until;
    compile_options.progress = progress_meter(options.messages, sources.size());
    run.compilation = compile(std::move(sources), compile_options, options.policy);
    return run;
}

}  // namespace popup::cli
