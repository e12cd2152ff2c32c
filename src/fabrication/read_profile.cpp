// Profiles from TOML files. All of toml++ lives here.
#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/nearest.h"
#include "popup/diagnostics.h"
#include "popup/profile.h"

namespace popup {
namespace {

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

class ProfileReader {
 public:
    explicit ProfileReader(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

    // Hands each key to the row that takes it; an unknown one is an error that names the nearest.
    struct Row {
        std::string_view key;
        std::function<void(const toml::node&)> take;
    };
    void read(const toml::table& table, std::string_view where, const std::vector<Row>& rows) {
        for (const auto& [key, node] : table) {
            const auto row = std::find_if(rows.begin(), rows.end(),
                                          [&key = key](const Row& one) { return one.key == key.str(); });
            if (row != rows.end()) {
                row->take(node);
                continue;
            }
            std::vector<std::string_view> known;
            known.reserve(rows.size());
            for (const Row& one : rows) known.push_back(one.key);
            Diagnostic& unknown =
                wrong(key.source(), fmt::format("there is no key \"{}\"{}", key.str(), where));
            const std::vector<std::string> meant = nearest(key.str(), known, 1);
            unknown.hint(meant.empty() ? fmt::format("keys: {}", fmt::join(known, ", "))
                                       : fmt::format("did you mean \"{}\"?", meant.front()));
        }
    }

    Diagnostic& wrong(const toml::source_region& region, std::string message) {
        return diagnostics_.error("bad-profile", place_of(region), std::move(message));
    }
    Diagnostic& wrong(const toml::node& node, std::string_view key, std::string_view wanted) {
        return wrong(node.source(), fmt::format("\"{}\" takes {}, not {}", key, wanted, kind_of(node)));
    }

    std::function<void(const toml::node&)> text(std::string key, std::string& value) {
        return [this, key = std::move(key), &value](const toml::node& node) {
            if (const auto* given = node.as_string()) {
                value = given->get();
            } else {
                wrong(node, key, "a string");
            }
        };
    }
    std::function<void(const toml::node&)> flag(std::string key, bool& value) {
        return [this, key = std::move(key), &value](const toml::node& node) {
            if (const auto* given = node.as_boolean()) {
                value = given->get();
            } else {
                wrong(node, key, "true or false");
            }
        };
    }
    std::function<void(const toml::node&)> length(std::string key, double& value, double least) {
        return [this, key = std::move(key), &value, least](const toml::node& node) {
            if (!node.is_number()) {
                wrong(node, key, "a number of millimetres");
                return;
            }
            const double given = node.is_integer() ? static_cast<double>(node.as_integer()->get())
                                                   : node.as_floating_point()->get();
            if (!std::isfinite(given) || given < least || given > 1000.0) {
                wrong(node.source(),
                      fmt::format("\"{}\" is {} mm; it must be from {} to 1000", key, given, least));
            } else {
                value = given;
            }
        };
    }
    std::function<void(const toml::node&)> table(std::string key,
                                                 std::function<void(const toml::table&)> use) {
        return [this, key = std::move(key), use = std::move(use)](const toml::node& node) {
            if (const auto* given = node.as_table()) {
                use(*given);
            } else {
                wrong(node, key, "a table");
            }
        };
    }
    std::function<void(const toml::node&)> folds(FoldStyle& value) {
        return [this, &value](const toml::node& node) {
            std::vector<std::string_view> names;
            for (const FoldStyle style : kFoldStyles) {
                names.push_back(to_string(style));
                if (node.value<std::string_view>() != names.back()) continue;
                value = style;
                return;
            }
            const std::string wanted = fmt::format("one of {}", fmt::join(names, ", "));
            if (const auto* given = node.as_string()) {
                wrong(node.source(), fmt::format("\"folds\" takes {}, not \"{}\"", wanted, given->get()));
            } else {
                wrong(node, "folds", wanted);
            }
        };
    }
    std::function<void(const toml::node&)> color(Color& value) {
        return [this, &value](const toml::node& node) {
            const auto* given = node.as_string();
            if (given == nullptr) {
                wrong(node, "color", "a string such as \"#ff0000\"");
                return;
            }
            if (const std::optional<Color> known = hex_color(given->get())) {
                value = *known;
                return;
            }
            wrong(node.source(),
                  fmt::format("\"color\" takes six hexadecimal digits after a #, not \"{}\"", given->get()))
                .hint("such as \"#ff0000\"");
        };
    }

 private:
    Diagnostics& diagnostics_;
};

// The parser follows dotted keys by recursion: no line may have more dots than any profile could need.
constexpr std::size_t kMostBytes = 65536;
constexpr std::ptrdiff_t kMostDots = 256;

std::optional<toml::table> parse(std::string_view text, ProfileReader& reader) {
    if (text.size() > kMostBytes) {
        reader.wrong(toml::source_region{},
                     fmt::format("a profile has at most {} bytes, not {}", kMostBytes, text.size()));
        return std::nullopt;
    }
    toml::source_region region;
    region.begin = {1, 1};
    for (std::size_t at = 0; at < text.size(); ++region.begin.line) {
        const std::string_view line = text.substr(at, text.find('\n', at) - at);
        if (std::count(line.begin(), line.end(), '.') > kMostDots) {
            reader.wrong(region, fmt::format("this line has more than {} dots", kMostDots));
            return std::nullopt;
        }
        at += line.size() + 1;
    }
    try {
        return toml::parse(text);
    } catch (const toml::parse_error& error) {
        reader.wrong(error.source(), fmt::format("this is not TOML: {}", error.description()));
        return std::nullopt;
    }
}

// The built-in profile that a file begins with; its own name is not taken over.
std::optional<Profile> base_of(const toml::table& file, ProfileReader& reader) {
    const toml::node* node = file.get("base");
    if (node == nullptr) return profile_table().front();
    const auto* name = node->as_string();
    if (name == nullptr) {
        reader.wrong(*node, "base", "the name of a profile");
        return std::nullopt;
    }
    if (const Profile* base = find_profile(name->get())) return *base;
    reader.wrong(node->source(), fmt::format("there is no profile \"{}\" to begin with", name->get()))
        .hint(fmt::format("profiles: {}", fmt::join(profile_names(), ", ")));
    return std::nullopt;
}

}  // namespace

std::optional<Profile> read_profile(const Source& source, Diagnostics& diagnostics) {
    ProfileReader reader(diagnostics);
    const std::optional<toml::table> parsed = parse(source.text, reader);
    if (!parsed) return std::nullopt;
    const toml::table& file = *parsed;
    std::optional<Profile> begun = base_of(file, reader);
    Profile profile = begun.value_or(profile_table().front());
    profile.name = source.stem();
    profile.about.clear();
    profile.verified = true;

    Perforation& perforation = profile.perforation;
    const auto read_perforation = [&](const toml::table& table) {
        reader.read(table, " in \"perforation\"",
                    {{"cut", reader.length("cut", perforation.cut_mm, Perforation::kLeastMm)},
                     {"gap", reader.length("gap", perforation.gap_mm, Perforation::kLeastMm)},
                     {"clear", reader.length("clear", perforation.clear_mm, 0.0)}});
    };
    const auto read_pens = [&](const toml::table& table) {
        std::vector<ProfileReader::Row> rows;
        rows.reserve(kOperations.size());
        for (const Operation operation : kOperations) {
            Pen& pen = profile.pens[static_cast<std::size_t>(operation)];
            // What is printed brings its own widths; of any other line no width at all would be no line.
            const bool printed =
                operation == Operation::fill || operation == Operation::draw || operation == Operation::label;
            const auto read_pen = [&reader, &pen, least = printed ? 0.0 : 0.001](const toml::table& one) {
                reader.read(one, " in a pen",
                            {{"layer", reader.text("layer", pen.layer)},
                             {"color", reader.color(pen.color)},
                             {"width", reader.length("width", pen.width_mm, least)}});
            };
            rows.push_back({to_string(operation), reader.table(std::string(to_string(operation)), read_pen)});
        }
        reader.read(table, " in \"pens\"", rows);
    };
    reader.read(file, "",
                {{"name", reader.text("name", profile.name)},
                 {"about", reader.text("about", profile.about)},
                 {"base", [](const toml::node&) { /* read first, see above */ }},
                 {"folds", reader.folds(profile.folds)},
                 {"one-sided", reader.flag("one-sided", profile.one_sided)},
                 {"styled-paths", reader.flag("styled-paths", profile.styled_paths)},
                 {"perforation", reader.table("perforation", read_perforation)},
                 {"pens", reader.table("pens", read_pens)}});
    if (diagnostics.has_errors()) return std::nullopt;
    return profile;
}

}  // namespace popup
