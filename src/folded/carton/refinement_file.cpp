// Refinement files: which joins were accepted, beside the drawing.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "popup/refinement.h"

namespace popup {
namespace {

using Json = nlohmann::ordered_json;

std::optional<std::size_t> kind_named(std::string_view name) {
    const auto* const found = std::find(kJoinKindNames.begin(), kJoinKindNames.end(), name);
    if (found == kJoinKindNames.end()) return std::nullopt;
    return static_cast<std::size_t>(found - kJoinKindNames.begin());
}

// The line of a byte, for errors of syntax.
Place place_of(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, std::min(byte, text.size()));
    Place place;
    place.line = 1 + static_cast<int>(std::count(before.begin(), before.end(), '\n'));
    const std::size_t last = before.rfind('\n');
    place.column = static_cast<int>(before.size() - (last == std::string_view::npos ? 0 : last + 1)) + 1;
    return place;
}

bool is_corner(const Json& value) {
    return value.is_array() && value.size() == 2 && value[0].is_number() && value[1].is_number();
}

std::optional<Join> join_of(const Json& value) {
    if (!value.is_object() || value.size() != 1) return std::nullopt;
    const auto kind = kind_named(value.begin().key());
    const Json& parts = value.begin().value();
    if (!kind || !parts.is_array()) return std::nullopt;
    Join join;
    join.kind = static_cast<JoinKind>(*kind);
    const bool merges = join.kind == JoinKind::merge;
    if (merges ? parts.size() < 2 : parts.size() != 2) return std::nullopt;
    for (const Json& part : parts) {
        if (!merges) {
            if (!part.is_string()) return std::nullopt;
            join.parts.push_back({part.get<std::string>(), {}});
            continue;
        }
        if (!part.is_object() || !part.contains("panel") || !part["panel"].is_string() ||
            !part.contains("corner") || !is_corner(part["corner"]))
            return std::nullopt;
        const Vec2 corner{part["corner"][0].get<double>(), part["corner"][1].get<double>()};
        join.parts.push_back({part["panel"].get<std::string>(), corner});
    }
    return join;
}

// To five decimals, and never -0.
double settled(double value) { return std::round(value * 1e5) / 1e5 + 0.0; }

}  // namespace

std::string write_refinement(const std::vector<Join>& joins) {
    std::string text = "{\n  \"joins\": [";
    for (std::size_t i = 0; i < joins.size(); ++i) {
        Json parts = Json::array();
        for (const JoinPart& part : joins[i].parts) {
            if (joins[i].kind == JoinKind::merge) {
                parts.push_back(
                    {{"panel", part.panel}, {"corner", {settled(part.corner.x), settled(part.corner.y)}}});
            } else {
                parts.push_back(part.panel);
            }
        }
        text += fmt::format("{}\n    {{\"{}\": {}}}", i == 0 ? "" : ",",
                            kJoinKindNames.at(static_cast<std::size_t>(joins[i].kind)), parts.dump());
    }
    return text + (joins.empty() ? "]\n}\n" : "\n  ]\n}\n");
}

std::optional<std::vector<Join>> read_refinement(const Source& source, Diagnostics& diagnostics) {
    Json tree;
    try {
        tree = Json::parse(source.text);
    } catch (const Json::parse_error& error) {
        const std::size_t byte = error.byte == 0 ? 0 : error.byte - 1;
        diagnostics.error("bad-refinement", place_of(source.text, byte), "this is no JSON from here on");
        return std::nullopt;
    }
    if (!tree.is_object() || !tree.contains("joins") || !tree["joins"].is_array()) {
        diagnostics.error("bad-refinement", {}, "a refinement file is an object with a list \"joins\"");
        return std::nullopt;
    }
    std::vector<Join> joins;
    for (const Json& one : tree["joins"]) {
        std::optional<Join> join = join_of(one);
        if (!join) {
            diagnostics
                .error("bad-refinement", {},
                       fmt::format("join {} is none: {}", joins.size() + 1, one.dump().substr(0, 80)))
                .hint(R"(joins are {"merge": [{"panel": "sheet/front", "corner": [20, 40]}, …]} or )"
                      R"({"paste": ["sheet/glue-flap", "sheet/front"]})");
            return std::nullopt;
        }
        joins.push_back(std::move(*join));
    }
    return joins;
}

}  // namespace popup
