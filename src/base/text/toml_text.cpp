#include "base/text/toml_text.h"

#include <fmt/format.h>

#include <algorithm>

namespace popup {
namespace {

// The parser follows dotted keys by recursion: no line may have more dots than any file could need.
constexpr std::size_t kMostBytes = 65536;
constexpr std::ptrdiff_t kMostDots = 256;

}  // namespace

Place place_of(const toml::source_region& region) {
    return {static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

std::string_view kind_of(const toml::node& node) {
    if (node.is_string()) return "a string";
    if (node.is_boolean()) return "true or false";
    if (node.is_number()) return "a number";
    if (node.is_table()) return "a table";
    if (node.is_array()) return "a list";
    return "a date or time";
}

std::optional<toml::table> parse_toml(std::string_view text, std::string_view code, std::string_view what,
                                      Diagnostics& diagnostics) {
    if (text.size() > kMostBytes) {
        diagnostics.error(code, {},
                          fmt::format("{} has at most {} bytes, not {}", what, kMostBytes, text.size()));
        return std::nullopt;
    }
    Place place{1, 1};
    for (std::size_t at = 0; at < text.size(); ++place.line) {
        const std::string_view line = text.substr(at, text.find('\n', at) - at);
        if (std::count(line.begin(), line.end(), '.') > kMostDots) {
            diagnostics.error(code, place, fmt::format("this line has more than {} dots", kMostDots));
            return std::nullopt;
        }
        at += line.size() + 1;
    }
    try {
        return toml::parse(text);
    } catch (const toml::parse_error& error) {
        Diagnostic& told = diagnostics.error(code, place_of(error.source()),
                                             fmt::format("this is not TOML: {}", error.description()));
        if (error.description().find("value type") != std::string_view::npos)
            told.hint("texts stand in quotes: sheet = \"a3\"");
        return std::nullopt;
    }
}

}  // namespace popup
