#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "cli/report.h"
#include "cli/verbs.h"
#include "popup/mechanism.h"
#include "popup/output.h"

namespace popup::cli {
namespace {

using Json = nlohmann::ordered_json;

// What there is, as rows of named values; text and JSON are two views of the same rows.
using Rows = std::vector<Json>;

std::string_view kind_of(const Format& format) {
    struct Kind {
        std::string_view operator()(SheetWriter) const { return "sheet"; }
        std::string_view operator()(SceneWriter) const { return "scene"; }
        std::string_view operator()(DocumentWriter) const { return "document"; }
        std::string_view operator()(ReportWriter) const { return "report"; }
    };
    return std::visit(Kind{}, format.write);
}

Rows formats() {
    Rows rows;
    for (const Format& row : format_table()) {
        rows.push_back({{"suffix", row.suffix}, {"kind", kind_of(row)}, {"about", row.about}});
    }
    return rows;
}

Rows languages() {
    Rows rows;
    for (const Language& row : language_table()) {
        rows.push_back({{"name", row.name}, {"suffix", row.suffix}, {"about", row.about}});
    }
    return rows;
}

Rows elements() {
    Rows rows;
    for (const ElementInfo& row : element_table()) {
        std::string points;
        for (const PointInfo& point : row.points)
            points += fmt::format("{}{}", points.empty() ? "" : " ", point.letter);
        rows.push_back({{"code", row.code >= 0 ? Json(row.code) : Json(nullptr)},
                        {"name", row.name},
                        {"glued", row.glued},
                        {"points", points},
                        {"about", row.about}});
    }
    return rows;
}

Rows sheets() {
    Rows rows;
    for (const Paper& row : paper_table()) {
        rows.push_back({{"name", row.name}, {"width_mm", row.width_mm}, {"height_mm", row.height_mm}});
    }
    return rows;
}

Rows codes() {
    Rows rows;
    for (const CodeInfo& row : code_table()) {
        rows.push_back({{"code", row.code}, {"severity", to_string(row.severity)}, {"summary", row.summary}});
    }
    return rows;
}

Rows profiles() {
    return {{{"name", "workshop"},
             {"about",
              "for scissors and knife: cut red, valley magenta dashed, mountain blue dashed, seam black "
              "dashed"}}};
}

struct Listing {
    std::string_view name;
    Rows (*rows)();
};
constexpr Listing kListings[] = {{"formats", formats},   {"languages", languages}, {"elements", elements},
                                 {"profiles", profiles}, {"sheets", sheets},       {"codes", codes}};

std::string cell(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_boolean()) return value.get<bool>() ? "glued" : "cut";
    if (value.is_number_float()) return fmt::format("{}", value.get<double>());
    return value.is_null() ? "-" : value.dump();
}

std::string aligned(const Rows& rows) {
    std::vector<std::size_t> widths;
    for (const Json& row : rows) {
        std::size_t column = 0;
        for (const Json& value : row) {
            if (column == widths.size()) widths.push_back(0);
            widths[column] = std::max(widths[column], cell(value).size());
            ++column;
        }
    }
    std::string text;
    for (const Json& row : rows) {
        std::string line;
        std::size_t column = 0;
        for (const Json& value : row) line += fmt::format("{:<{}}  ", cell(value), widths[column++]);
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    }
    return text;
}

}  // namespace

CLI::App* add_list(CLI::App& app, Options& options) {
    CLI::App* verb =
        app.add_subcommand("list", "What there is: formats, languages, elements, profiles, sheets, codes");
    verb->add_option("WHAT", options.list.what, "formats, languages, elements, profiles, sheets or codes")
        ->required()
        ->type_name("");
    verb->add_flag("--json", options.list.json, "as a JSON array of objects");
    verb->footer(
        "Examples:\n"
        "  popupc list formats\n"
        "  popupc list codes --json");
    return verb;
}

int run_list(const Options& options) {
    std::vector<std::string_view> names;
    for (const Listing& listing : kListings) {
        names.push_back(listing.name);
        if (listing.name != options.list.what) continue;
        const Rows rows = listing.rows();
        const std::string text = options.list.json ? Json(rows).dump(2) + "\n" : aligned(rows);
        return print(text) ? exit_done : exit_unusable;
    }
    throw UsageError(fmt::format("there is no list of \"{}\"", options.list.what),
                     {fmt::format("lists: {}", fmt::join(names, " "))});
}

}  // namespace popup::cli
