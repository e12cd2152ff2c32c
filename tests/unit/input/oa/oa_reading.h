// A design of webOAcard as it was read, with what was found of it.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "popup/language.h"

namespace popup::test {

struct Read {
    std::optional<Assembly> assembly;
    std::vector<Diagnostic> findings;
    [[nodiscard]] std::string told() const {
        std::string all;
        for (const Diagnostic& d : findings) all += d.code + ": " + d.message + "\n";
        return all;
    }
    [[nodiscard]] std::size_t count(const std::string& code) const {
        return static_cast<std::size_t>(std::count_if(findings.begin(), findings.end(),
                                                      [&](const Diagnostic& d) { return d.code == code; }));
    }
    [[nodiscard]] bool has_errors() const {
        return std::any_of(findings.begin(), findings.end(),
                           [](const Diagnostic& d) { return d.severity == Severity::error; });
    }
};

inline Read read(const std::string& text, bool strict = false) {
    Diagnostics diagnostics("card.oa");
    ReadOptions options;
    options.strict = strict;
    Reading reading = read_source_text(Source{"card.oa", text}, options, diagnostics);
    return {std::move(reading.assembly), diagnostics.sorted()};
}

}  // namespace popup::test
