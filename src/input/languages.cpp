// The input languages, and how one is chosen.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "input/text.h"
#include "input/xml/read.h"
#include "popup/design.h"

namespace popup {
namespace {

// The row that is named, or else the one of the suffix; null when there is none.
const Language* choose(const Source& source, std::string_view name) {
    const std::vector<Language>& table = language_table();
    const std::string wanted = lower(name.empty() ? std::string_view(source.name) : name);
    const auto row = std::find_if(table.begin(), table.end(), [&](const Language& candidate) {
        return name.empty() ? wanted.ends_with(candidate.suffix) : wanted == candidate.name;
    });
    if (row != table.end()) return &*row;
    // Standard input has no suffix; while there is one language only, that one is meant.
    if (name.empty() && source.name == "-" && table.size() == 1) return &table.front();
    return nullptr;
}

}  // namespace

std::vector<Language> const& language_table() {
    static const std::vector<Language> table{
        {"xml", ".xml", "popup document, as Popup Workshop's thesis describes it", xml::read, xml::patch},
    };
    return table;
}

std::optional<Design> read_design(const Source& source, const ReadOptions& options,
                                  Diagnostics& diagnostics) {
    if (const Language* language = choose(source, options.language)) {
        return language->read(source, options, diagnostics);
    }
    std::string known;
    for (const Language& row : language_table()) {
        known += fmt::format("{}{} ({})", known.empty() ? "" : ", ", row.name, row.suffix);
    }
    diagnostics
        .error("unknown-language", {},
               options.language.empty()
                   ? std::string("the name of the input does not tell its language")
                   : fmt::format("the language '{}' is not known", shown(options.language)))
        .hint("--from names the language; known are " + known);
    return std::nullopt;
}

}  // namespace popup
