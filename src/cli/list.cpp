#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <nlohmann/json.hpp>

#include "cli/report.h"
#include "cli/verbs.h"
#include "popup/edit.h"
#include "popup/mechanism.h"
#include "popup/output.h"

namespace popup::cli {
namespace {

using Json = nlohmann::ordered_json;

// What there is, as rows of named values; text and JSON are two views of the same rows.
using Rows = std::vector<Json>;

std::string_view kind_word(const Format& format) {
    struct Kind {
        std::string_view operator()(SheetWriter) const { return "sheet"; }
        std::string_view operator()(SceneWriter) const { return "scene"; }
        std::string_view operator()(StillWriter) const { return "picture"; }
        std::string_view operator()(PageWriter) const { return "page"; }
        std::string_view operator()(DocumentWriter) const { return "document"; }
        std::string_view operator()(ReportWriter) const { return "report"; }
    };
    return std::visit(Kind{}, format.write);
}

Rows formats() {
    Rows rows;
    for (const Format& row : format_table()) {
        rows.push_back({{"suffix", row.suffix}, {"kind", kind_word(row)}, {"about", row.about}});
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

Json measures_of(const ElementInfo& row) {
    constexpr std::array kKinds{"length", "angle", "choice"};
    Json made = Json::array();
    for (const MeasureInfo& measure : row.measures) {
        Json& one = made.emplace_back(Json{{"name", measure.name},
                                           {"kind", kKinds.at(static_cast<std::size_t>(measure.kind))},
                                           {"about", measure.about}});
        if (!measure.words.empty()) one["words"] = measure.words;
        if (measure.relative) one["relative"] = true;
    }
    return made;
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
                        {"about", row.about},
                        {"measures", measures_of(row)}});
    }
    return rows;
}

Rows templates() {
    Rows rows;
    for (const CardTemplate& row : card_templates())
        rows.push_back({{"name", row.name}, {"about", row.about}});
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
    Rows rows;
    for (const Profile& row : profile_table()) {
        Json pens = Json::object();
        for (const Operation operation : kOperations) {
            const Pen& pen = row.pen(operation);
            if (pen.layer.empty()) continue;
            Json& drawn = pens[std::string(to_string(operation))] = {
                {"layer", pen.layer}, {"color", to_string(pen.color)}, {"width_mm", pen.width_mm}};
            if (!pen.spot.empty()) drawn["spot"] = pen.spot;
        }
        rows.push_back({{"name", row.name},
                        {"folds", to_string(row.folds)},
                        {"verified", row.verified},
                        {"about", row.about},
                        {"breaks_away_folds", row.away_folds == AwayFolds::broken},
                        {"one_sided", row.one_sided},
                        {"styled_paths", row.styled_paths},
                        {"machine_order", row.machine_order},
                        {"outlined_text", row.outlined_text},
                        {"formats", row.formats},
                        {"perforation",
                         {{"cut_mm", row.perforation.cut_mm},
                          {"gap_mm", row.perforation.gap_mm},
                          {"clear_mm", row.perforation.clear_mm}}},
                        {"pens", std::move(pens)}});
    }
    return rows;
}

struct Listing {
    std::string_view name;
    Rows (*rows)();
};
constexpr Listing kListings[] = {{"formats", formats},   {"languages", languages}, {"elements", elements},
                                 {"profiles", profiles}, {"sheets", sheets},       {"templates", templates},
                                 {"codes", codes}};

// How a member of a row is shown in text; nullopt: in JSON only.
std::optional<std::string> cell(const std::string& name, const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (name == "glued") return value.get<bool>() ? "glued" : "cut";
    if (name == "verified") return value.get<bool>() ? "verified" : "unverified";
    if (value.is_boolean() || value.is_structured()) return std::nullopt;
    if (value.is_number_float()) return fmt::format("{}", value.get<double>());
    return value.is_null() ? "-" : value.dump();
}

std::string aligned(const Rows& rows) {
    std::vector<std::vector<std::string>> lines;
    std::vector<std::size_t> widths;
    for (const Json& row : rows) {
        std::vector<std::string>& cells = lines.emplace_back();
        for (const auto& [name, value] : row.items()) {
            std::optional<std::string> text = cell(name, value);
            if (!text) continue;
            if (cells.size() == widths.size()) widths.push_back(0);
            widths[cells.size()] = std::max(widths[cells.size()], text->size());
            cells.push_back(std::move(*text));
        }
    }
    std::string text;
    for (const std::vector<std::string>& cells : lines) {
        std::string line;
        for (std::size_t i = 0; i < cells.size(); ++i) line += fmt::format("{:<{}}  ", cells[i], widths[i]);
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    }
    return text;
}

const Listing& listing_named(std::string_view name) {
    std::vector<std::string_view> names;
    for (const Listing& listing : kListings) {
        if (listing.name == name) return listing;
        names.push_back(listing.name);
    }
    throw UsageError(fmt::format("there is no list of \"{}\"", name),
                     {fmt::format("lists: {}", fmt::join(names, " "))}, names);
}

}  // namespace

CLI::App* add_list(CLI::App& app, Options& options) {
    CLI::App* verb =
        app.add_subcommand("list", "What there is: formats, languages, elements, profiles, sheets and more");
    verb->add_option_function<std::string>(
            "WHAT", [&options](const std::string& text) { options.list.what = listing_named(text).name; },
            "formats, languages, elements, profiles, sheets, templates or codes")
        ->required()
        ->type_name("");
    verb->add_flag("--json", options.list.json, "as a JSON array of objects")->configurable(false);
    verb->footer(
        "Examples:\n"
        "  popupc list formats\n"
        "  popupc list codes --json");
    return verb;
}

int run_list(const Options& options) {
    const Rows rows = listing_named(options.list.what).rows();
    return print(options.list.json ? Json(rows).dump(2) + "\n" : aligned(rows)) ? exit_done : exit_unusable;
}

}  // namespace popup::cli
