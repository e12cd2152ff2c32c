// Profiles from TOML files.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/nth.h"
#include "base/text/nearest.h"
#include "base/text/toml_text.h"
#include "popup/diagnostics.h"
#include "popup/profile.h"

namespace popup {
namespace {

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
    // A name that stands in files: not empty unless `may_be_empty`, without control characters, and none of
    // those that mean something else there.
    std::function<void(const toml::node&)> name(std::string key, std::string& value, bool may_be_empty,
                                                std::vector<std::string_view> taken = {}) {
        return [this, key = std::move(key), &value, may_be_empty,
                taken = std::move(taken)](const toml::node& node) {
            const auto* given = node.as_string();
            if (given == nullptr) {
                wrong(node, key, "a string");
                return;
            }
            const std::string& text = given->get();
            const bool control = std::any_of(text.begin(), text.end(), [](char c) {
                return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
            });
            if (text.empty() && !may_be_empty) {
                wrong(node.source(), fmt::format("\"{}\" is empty", key));
            } else if (control) {
                wrong(node.source(), fmt::format("\"{}\" has control characters", key));
            } else if (std::find(taken.begin(), taken.end(), text) != taken.end()) {
                wrong(node.source(),
                      fmt::format("\"{}\" cannot be \"{}\", which has a meaning of its own", key, text));
            } else {
                value = text;
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
    // A number of `unit`, such as "mm".
    struct Range {
        double least, most;
        std::string_view unit;
        bool or_zero = false;  // 0 says that there is none
    };
    void number(const toml::node& node, const std::string& key, double& value, const Range& range) {
        if (!node.is_number()) {
            wrong(node, key, fmt::format("a number of {}", range.unit == "mm" ? "millimetres" : range.unit));
            return;
        }
        const double given = node.is_integer() ? static_cast<double>(node.as_integer()->get())
                                               : node.as_floating_point()->get();
        const bool none = range.or_zero && given == 0.0;
        if (!none && (!std::isfinite(given) || given < range.least || given > range.most)) {
            wrong(node.source(),
                  fmt::format("\"{}\" is {} {}; it must be {}from {} to {}", key, given, range.unit,
                              range.or_zero ? "0 or " : "", range.least, range.most));
        } else {
            value = given;
        }
    }
    std::function<void(const toml::node&)> number(std::string key, double& value, Range range) {
        return [this, key = std::move(key), &value, range](const toml::node& node) {
            number(node, key, value, range);
        };
    }
    std::function<void(const toml::node&)> length(std::string key, double& value, double least) {
        return number(std::move(key), value, {least, 1000.0, "mm"});
    }
    // Names out of `known`; empty: any.
    std::function<void(const toml::node&)> texts(std::string key, std::vector<std::string>& values,
                                                 std::span<const std::string_view> known) {
        return [this, key = std::move(key), &values, known](const toml::node& node) {
            const auto* given = node.as_array();
            if (given == nullptr) {
                wrong(node, key, "a list of strings");
                return;
            }
            values.clear();
            for (const toml::node& one : *given) {
                const auto* text = one.as_string();
                const auto plain = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); };
                if (text != nullptr && !text->get().empty() &&
                    std::all_of(text->get().begin(), text->get().end(), plain)) {
                    values.push_back(text->get());
                    if (known.empty() || std::find(known.begin(), known.end(), text->get()) != known.end())
                        continue;
                    const std::vector<std::string> meant = nearest(text->get(), known, 1);
                    wrong(one.source(),
                          fmt::format("\"{}\" names \"{}\", and there is no such format", key, text->get()))
                        .hint(meant.empty() ? fmt::format("formats: {}", fmt::join(known, ", "))
                                            : fmt::format("did you mean \"{}\"?", meant.front()));
                } else {
                    wrong(one.source(), fmt::format("\"{}\" takes a list of names such as \"svg\"", key));
                }
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
    // One of a closed list of values, by its name.
    template <typename Value, std::size_t count>
    std::function<void(const toml::node&)> choice(std::string key, Value& value,
                                                  const std::array<Value, count>& values) {
        return [this, key = std::move(key), &value, &values](const toml::node& node) {
            std::vector<std::string_view> names;
            for (const Value one : values) {
                names.push_back(to_string(one));
                if (node.value<std::string_view>() != names.back()) continue;
                value = one;
                return;
            }
            const std::string wanted = fmt::format("one of {}", fmt::join(names, ", "));
            if (const auto* given = node.as_string()) {
                wrong(node.source(), fmt::format("\"{}\" takes {}, not \"{}\"", key, wanted, given->get()));
            } else {
                wrong(node, key, wanted);
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

constexpr double kLeastJointMm = 0.05;  // narrower bridges hold nothing
constexpr ProfileReader::Range kSpeeds{0.001, 1e5, "mm/s"};

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

std::optional<Profile> read_profile(const Source& source, Diagnostics& diagnostics,
                                    std::span<const std::string_view> formats) {
    ProfileReader reader(diagnostics);
    const std::optional<toml::table> parsed =
        parse_toml(source.text, "bad-profile", "a profile", diagnostics);
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
            Pen& pen = nth(profile.pens, operation);
            // What is printed brings its own widths; of any other line no width at all would be no line.
            const bool printed =
                operation == Operation::fill || operation == Operation::draw || operation == Operation::label;
            const auto read_pen = [&reader, &pen, least = printed ? 0.0 : 0.001,
                                   closed = operation >= Operation::inner_cut](const toml::table& one) {
                std::vector<ProfileReader::Row> keys{
                    {"layer", reader.text("layer", pen.layer)},
                    {"color", reader.color(pen.color)},
                    {"width", reader.length("width", pen.width_mm, least)},
                    {"speed", reader.number("speed", pen.speed_mm_s, kSpeeds)},
                    {"power", reader.number("power", pen.power_percent, {0.0, 100.0, "percent"})},
                    {"spot", reader.name("spot", pen.spot, true, {"All", "None"})}};
                // Only closed cuts have an inside and an outside to move away from.
                if (closed) keys.push_back({"kerf", reader.number("kerf", pen.kerf_mm, {0.0, 10.0, "mm"})});
                reader.read(one, " in a pen", keys);
            };
            rows.push_back({to_string(operation), reader.table(std::string(to_string(operation)), read_pen)});
        }
        reader.read(table, " in \"pens\"", rows);
    };
    const auto read_bed = [&](const toml::table& table) {
        constexpr ProfileReader::Range kBed{1.0, 1e5, "mm"};
        profile.bed_width_mm = profile.bed_height_mm = 0.0;
        reader.read(table, " in \"bed\"",
                    {{"width", reader.number("width", profile.bed_width_mm, kBed)},
                     {"height", reader.number("height", profile.bed_height_mm, kBed)}});
        if (profile.bed_width_mm > 0.0 && profile.bed_height_mm > 0.0) return;
        reader.wrong(table.source(), "\"bed\" takes both width and height");
    };
    const auto read_travel = [&](const toml::table& table) {
        reader.read(table, " in \"travel\"",
                    {{"speed", reader.number("speed", profile.travel_mm_s, kSpeeds)},
                     {"pierce", reader.number("pierce", profile.pierce_s, {0.0, 60.0, "seconds"})}});
    };
    reader.read(file, "",
                {{"name", reader.name("name", profile.name, false)},
                 {"about", reader.text("about", profile.about)},
                 {"base", [](const toml::node&) { /* read first, see above */ }},
                 {"folds", reader.choice("folds", profile.folds, kFoldStyles)},
                 {"away-folds", reader.choice("away-folds", profile.away_folds, kAwayFolds)},
                 {"one-sided", reader.flag("one-sided", profile.one_sided)},
                 {"styled-paths", reader.flag("styled-paths", profile.styled_paths)},
                 {"machine-order", reader.flag("machine-order", profile.machine_order)},
                 {"outlined-text", reader.flag("outlined-text", profile.outlined_text)},
                 {"marks", reader.choice("marks", profile.marks, kMarks)},
                 {"marks-on", reader.choice("marks-on", profile.marks_on, kMarksOn)},
                 {"joints", reader.number("joints", profile.joint_mm, {kLeastJointMm, 10.0, "mm", true})},
                 {"bed", reader.table("bed", read_bed)},
                 {"travel", reader.table("travel", read_travel)},
                 {"formats", reader.texts("formats", profile.formats, formats)},
                 {"perforation", reader.table("perforation", read_perforation)},
                 {"pens", reader.table("pens", read_pens)}});
    if (diagnostics.has_errors()) return std::nullopt;
    return profile;
}

}  // namespace popup
