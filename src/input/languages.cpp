// The input languages, and how one is chosen.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "input/drawing/read.h"
#include "input/text.h"
#include "input/xml/read.h"
#include "popup/design.h"
#include "popup/part_list.h"

namespace popup {

std::vector<Language> const& language_table() {
    static const std::vector<Language> table{
        {"xml", ".xml", "popup document, as Popup Workshop's thesis describes it", xml::read, xml::patch},
        {"svg", ".svg", "drawing of closed cut contours, each a flat part", nullptr, nullptr, drawing::read,
         drawing::recognises},
    };
    return table;
}

const Language* find_language(const Source& source, std::string_view language) {
    const std::vector<Language>& table = language_table();
    const std::string wanted = lower(language.empty() ? std::string_view(source.name) : language);
    const bool standard_input = language.empty() && source.name == "-";
    const auto row = std::find_if(table.begin(), table.end(), [&](const Language& candidate) {
        if (standard_input) return candidate.recognises != nullptr && candidate.recognises(source.text);
        return language.empty() ? wanted.ends_with(candidate.suffix) : wanted == candidate.name;
    });
    if (row != table.end()) return &*row;
    return standard_input ? &table.front() : nullptr;
}

std::string known_languages() {
    std::string known;
    for (const Language& row : language_table()) {
        known += fmt::format("{}{} ({})", known.empty() ? "" : ", ", row.name, row.suffix);
    }
    return known;
}

std::optional<Design> read_design(const Source& source, const ReadOptions& options,
                                  Diagnostics& diagnostics) {
    const Language* language = find_language(source, options.language);
    if (language != nullptr && language->read != nullptr) {
        return language->read(source, options, diagnostics);
    }
    if (language != nullptr) {
        diagnostics.error("no-design", {}, "this describes flat parts, not the design of a pop-up card");
        return std::nullopt;
    }
    diagnostics
        .error("unknown-language", {},
               options.language.empty()
                   ? std::string("the name of the input does not tell its language")
                   : fmt::format("the language '{}' is not known", shown(options.language)))
        .hint("--from names the language; known are " + known_languages());
    return std::nullopt;
}

}  // namespace popup
