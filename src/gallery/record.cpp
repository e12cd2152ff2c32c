#include "gallery/record.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "base/diagnostics/render_diagnostics.h"
#include "base/system/digest.h"
#include "base/text/numbers.h"
#include "gallery/names.h"
#include "popup/files.h"

namespace popup {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kKeyDigits = 32;
constexpr std::size_t kLongestRecord = std::size_t{1} << 32U;
constexpr int kDecimals = 3;

void turn_names(std::vector<FileDigest>& files, std::string (*turn)(const std::string&)) {
    for (FileDigest& file : files) file.file = turn(file.file);
}

ordered_json tile_json(const GalleryTile& tile) {
    ordered_json elements = ordered_json::object();
    for (const auto& [name, count] : tile.elements) elements[name] = count;
    return {{"elements", std::move(elements)},
            {"size_mm", {rounded(tile.width_mm, kDecimals), rounded(tile.height_mm, kDecimals)}},
            {"pieces", tile.pieces},
            {"sheets", tile.sheets},
            {"page", tile.page},
            {"picture", tile.picture}};
}

// What the label says is not in the line again.
GalleryTile tile_of(const ordered_json& json, const std::string& label) {
    GalleryTile tile;
    tile.title = Source{label, {}}.stem();
    tile.file = label;
    for (const auto& [name, count] : json.at("elements").items())
        tile.elements.emplace_back(name, count.get<std::size_t>());
    tile.width_mm = json.at("size_mm").at(0).get<double>();
    tile.height_mm = json.at("size_mm").at(1).get<double>();
    tile.pieces = json.at("pieces").get<std::size_t>();
    tile.sheets = json.at("sheets").get<std::size_t>();
    tile.page = json.at("page").get<std::string>();
    tile.picture = json.at("picture").get<std::string>();
    return tile;
}

std::string text_of(const ordered_json& json, const char* key) {
    const auto at = json.find(key);
    return at != json.end() && at->is_string() ? at->get<std::string>() : std::string();
}

Place place_of(const ordered_json& json) {
    const auto number = [&json](const char* key) {
        const auto at = json.find(key);
        return at != json.end() && at->is_number_integer() ? at->get<int>() : 0;
    };
    return {number("line"), number("column")};
}

// As to_json() has it; nullopt when the code is none of this program.
std::optional<Diagnostic> diagnostic_of(const ordered_json& json) {
    Diagnostic one;
    one.code = text_of(json, "code");
    if (find_code(one.code) == nullptr) return std::nullopt;
    const std::string severity = text_of(json, "severity");
    for (const Severity known : {Severity::remark, Severity::warning, Severity::error}) {
        if (severity == to_string(known)) one.severity = known;
    }
    one.file = text_of(json, "file");
    one.place = place_of(json);
    one.message = text_of(json, "message");
    one.element = text_of(json, "element");
    if (json.contains("before") && json.at("before").is_string())
        one.change = Change{text_of(json, "before"), text_of(json, "after")};
    for (const ordered_json& hint : json.at("hints")) one.hints.push_back(hint.get<std::string>());
    if (json.contains("related")) {
        for (const ordered_json& other : json.at("related"))
            one.related.push_back({place_of(other), text_of(other, "text")});
    }
    return one;
}

}  // namespace

std::string to_line(const GalleryRow& row) {
    JobResult result = row.result;
    result.key = sha256(row.label).substr(0, kKeyDigits);
    turn_names(result.inputs, escaped_name);
    turn_names(result.outputs, escaped_name);
    ordered_json findings = ordered_json::array();
    for (const Diagnostic& one : row.findings) findings.push_back(to_json(one));
    result.diagnostics = findings.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
    // The line of a batch's result, and what is a gallery's behind it.
    std::string line = to_line(result);
    line.resize(line.rfind('}'));
    const ordered_json label = escaped_name(row.label);
    return line + ",\"label\":" + label.dump() +
           ",\"tile\":" + (row.tile ? tile_json(*row.tile) : ordered_json()).dump() + "}\n";
}

std::optional<GalleryRow> gallery_row_of(std::string_view line) {
    std::optional<JobResult> result = result_of(line);
    if (!result) return std::nullopt;
    try {
        const ordered_json json = ordered_json::parse(line);
        GalleryRow row;
        row.label = unescaped_name(json.at("label").get<std::string>());
        row.result = std::move(*result);
        turn_names(row.result.inputs, unescaped_name);
        turn_names(row.result.outputs, unescaped_name);
        for (const ordered_json& one : json.at("diagnostics")) {
            std::optional<Diagnostic> finding = diagnostic_of(one);
            if (!finding) return std::nullopt;
            row.findings.push_back(std::move(*finding));
        }
        if (!json.at("tile").is_null()) {
            row.tile = tile_of(json.at("tile"), row.label);
            tell_findings(row.findings, *row.tile);
        }
        return row;
    } catch (const ordered_json::exception&) {
        return std::nullopt;
    }
}

bool GalleryRecord::read(const std::string& name, Diagnostics& diagnostics) {
    std::error_code error;
    if (!std::filesystem::exists(name, error) && !error) return true;
    const std::optional<Source> source = read_source(name, diagnostics, kLongestRecord);
    if (!source) return false;
    for (std::string_view rest = source->text; !rest.empty();) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
        if (std::optional<GalleryRow> row = gallery_row_of(line)) add(std::move(*row));
    }
    return true;
}

void GalleryRecord::add(GalleryRow row) {
    for (const FileDigest& file : row.result.outputs) own_[file.file].insert(file.sha256);
    std::string label = row.label;
    rows_.insert_or_assign(std::move(label), std::move(row));
}

void GalleryRecord::remove(const std::string& label) { rows_.erase(label); }

const GalleryRow* GalleryRecord::find(const std::string& label) const {
    const auto at = rows_.find(label);
    return at == rows_.end() ? nullptr : &at->second;
}

bool GalleryRecord::has_written(const FileDigest& file) const {
    const auto at = own_.find(file.file);
    return at != own_.end() && at->second.contains(file.sha256);
}

}  // namespace popup
