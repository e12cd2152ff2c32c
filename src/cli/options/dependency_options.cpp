#include "cli/options/dependency_options.h"

#include <algorithm>

#include "cli/options/value_option.h"
#include "popup/files.h"

namespace popup::cli {

void add_dependency_options(CLI::App& verb, Options& options) {
    DependencyOptions& wanted = options.build.dependencies;
    const std::string group = "Dependencies";
    verb.add_flag("--MD", wanted.wanted,
                  "write what was read and written for make or ninja, as FIRSTOUTPUT.d")
        ->configurable(false)
        ->group(group);
    value(verb, "--MF", "FILE", "with -MD: to this file", group, [&wanted](std::string_view text) {
        wanted.file = text;
    })->configurable(false);
    values(verb, "--MT", "NAME", "with -MD: this target, instead of the outputs. Repeatable", group,
           [&wanted](std::string_view text) { wanted.targets.emplace_back(text); })
        ->configurable(false);
    verb.add_flag("--MP", wanted.phony, "with -MD: a rule without recipe for the inputs")
        ->configurable(false)
        ->group(group);
    value(verb, "--deps-format", "FORMAT", "with -MD: make (default) or json", group,
          [&wanted](std::string_view text) {
              wanted.format = choose<DependencyFormat>(
                  "--deps-format", text,
                  {{"make", DependencyFormat::make}, {"json", DependencyFormat::json}});
              wanted.format_given = true;
          })
        ->configurable(false);
}

std::vector<std::string> with_long_dependency_options(const std::vector<std::string>& arguments) {
    std::vector<std::string> words;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const std::string& word = arguments[i];
        if (word == "--") {
            words.insert(words.end(), arguments.begin() + static_cast<std::ptrdiff_t>(i), arguments.end());
            break;
        }
        if (word == "-MD" || word == "-MP") {
            words.push_back("-" + word);
        } else if (word.starts_with("-MF") || word.starts_with("-MT")) {
            const bool apart = word.size() == 3;
            const std::string given = !apart                     ? word.substr(3)
                                      : i + 1 < arguments.size() ? arguments[++i]
                                                                 : std::string();
            if (given.empty()) {
                throw UsageError(
                    fmt::format("{} takes the name of a {}", word, word == "-MF" ? "file" : "target"));
            }
            words.push_back("-" + word.substr(0, 3) + "=" + given);
        } else {
            words.push_back(word);
        }
    }
    return words;
}

std::string shown_option(const std::string& long_name) {
    const bool upper =
        std::all_of(long_name.begin(), long_name.end(), [](char c) { return c >= 'A' && c <= 'Z'; });
    return (upper ? "-" : "--") + long_name;
}

std::string dependency_file_name(const Options& options) {
    const DependencyOptions& wanted = options.build.dependencies;
    const std::vector<std::string>& outputs = options.build.outputs;
    if (!wanted.wanted) {
        for (const auto& [given, name] :
             {std::pair(!wanted.file.empty(), "-MF"), std::pair(!wanted.targets.empty(), "-MT"),
              std::pair(wanted.phony, "-MP"), std::pair(wanted.format_given, "--deps-format")}) {
            if (!given) continue;
            throw UsageError(
                fmt::format("{} says how a dependency file is to be, and none is asked for", name),
                {"add -MD"});
        }
        return {};
    }
    std::string nameless;
    for (const std::string& output : outputs) {
        if (is_standard_output(output)) nameless = "-o " + output;
    }
    if (options.build.emit) nameless = "--emit";
    if (!nameless.empty()) {
        throw UsageError(
            fmt::format("-MD names the files of the run, and {} goes to standard output", nameless),
            {"write to files with -o"});
    }
    if (wanted.format == DependencyFormat::json && (wanted.phony || !wanted.targets.empty())) {
        throw UsageError(fmt::format("{} is about rules, which JSON has not", wanted.phony ? "-MP" : "-MT"));
    }
    if (!wanted.file.empty()) return wanted.file;
    if (outputs.empty()) return {};
    const std::string& first = outputs.front();
    const std::size_t name = first.rfind('/') == std::string::npos ? 0 : first.rfind('/') + 1;
    const std::size_t dot = first.rfind('.');
    const bool has_suffix = dot != std::string::npos && dot > name;
    return first.substr(0, has_suffix ? dot : first.size()) +
           (wanted.format == DependencyFormat::make ? ".d" : ".d.json");
}

}  // namespace popup::cli
