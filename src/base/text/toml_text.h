// TOML texts as tables, with places that diagnostics can name. All of toml++ comes through here.
#pragma once

#include <toml++/toml.h>

#include <optional>
#include <string_view>

#include "popup/diagnostics.h"

namespace popup {

// Where a key or a value begins.
Place place_of(const toml::source_region& region);

// What a value is, in words that follow "not": "a string", "true or false", "a list".
std::string_view kind_of(const toml::node& node);

// The text's table. nullopt when it is no TOML, or longer or deeper than any file of its kind would be: an
// error `code` with its place is added, in which `what`, such as "a profile", is the subject. At most 64 KiB
// are read.
std::optional<toml::table> parse_toml(std::string_view text, std::string_view code, std::string_view what,
                                      Diagnostics& diagnostics);

}  // namespace popup
