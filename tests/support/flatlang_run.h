// FlatLang programs for tests, and what came of running them.
#pragma once

#include <fmt/format.h>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "input/flatlang/run/interpreter.h"

namespace popup::flatlang::test {

struct Ran {
    ProgramRun result;
    std::vector<Diagnostic> findings;

    [[nodiscard]] const std::string& printed() const { return result.printed; }
    // A line each: "3:5 error flatlang-runtime: the message", and "  its hint".
    [[nodiscard]] std::string told() const {
        std::string text;
        for (const Diagnostic& one : findings) {
            const char* severity = one.severity == Severity::error ? "error" : "warning";
            text += fmt::format("{}:{} {} {}: {}\n", one.place.line, one.place.column, severity, one.code,
                                one.message);
            for (const std::string& hint : one.hints) text += "  " + hint + "\n";
        }
        return text;
    }
    // Without hints.
    [[nodiscard]] std::string sentences() const {
        std::string text;
        for (const Diagnostic& one : findings) {
            text += fmt::format("{}:{} {}\n", one.place.line, one.place.column, one.message);
        }
        return text;
    }
};

using Files = std::map<std::string, std::string>;

inline ReadOptions with_files(const Files& files) {
    ReadOptions options;
    options.program.read_file = [files](const std::string& path) -> std::optional<Source> {
        const auto found = files.find(path);
        if (found == files.end()) return std::nullopt;
        return Source{path, found->second};
    };
    return options;
}

inline Ran run(const std::string& text, const ReadOptions& options = with_files({})) {
    Diagnostics diagnostics("main.fl");
    Ran made;
    made.result = run_program({"main.fl", text}, options, diagnostics);
    made.findings = diagnostics.sorted();
    return made;
}

inline Ran run_2008(const std::string& text, const Files& files = {}) {
    ReadOptions options = with_files(files);
    options.program.as_2008 = true;
    return run(text, options);
}

inline Ran run_with(const std::string& text, std::vector<std::pair<std::string, std::string>> definitions) {
    ReadOptions options = with_files({});
    options.program.definitions = std::move(definitions);
    return run(text, options);
}

}  // namespace popup::flatlang::test
