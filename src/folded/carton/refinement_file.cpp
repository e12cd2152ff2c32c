// Refinement files: which joins were accepted, beside the drawing.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/text/json_tree.h"
#include "base/text/place_at.h"
#include "base/text/shown.h"
#include "popup/refinement.h"

namespace popup {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kLargestCorner = 1e9;  // in units of the drawing; what is larger is a mistake
constexpr double kLargestNumber = 1e6;  // of a suggestion
constexpr std::string_view kNumber = "number";
constexpr std::string_view kWhatJoinsAre =
    R"(joins are {"merge": [{"panel": "sheet/front", "corner": [20, 40]}, …]} or )"
    R"({"paste": ["sheet/glue-flap", "sheet/front"]}, or "coplanar" or "glue" in place of "paste", and )"
    R"(may have a "number")";

std::optional<JoinKind> kind_named(std::string_view name) {
    const auto* const found = std::find(kJoinKindNames.begin(), kJoinKindNames.end(), name);
    if (found == kJoinKindNames.end()) return std::nullopt;
    return static_cast<JoinKind>(found - kJoinKindNames.begin());
}

// A member that `known` does not have; null: there is none.
template <std::size_t N>
const JsonMember* unknown_member(const JsonObject& object, const std::array<std::string_view, N>& known) {
    const auto found = std::find_if(object.begin(), object.end(), [&](const JsonMember& one) {
        return std::find(known.begin(), known.end(), one.name) == known.end();
    });
    return found == object.end() ? nullptr : &*found;
}

class Reader {
 public:
    Reader(const Source& source, const Ruler& ruler, Diagnostics& diagnostics)
        : text_(source.text), ruler_(ruler), diagnostics_(diagnostics) {}

    std::optional<std::vector<Join>> run() {
        const std::optional<JsonValue> tree = read_json(text_, "bad-refinement", diagnostics_);
        if (!tree) return std::nullopt;
        const JsonValue* const all = tree->member("joins");
        const JsonList* const list = all == nullptr ? nullptr : all->list();
        if (list == nullptr) {
            refuse(tree->at, "a refinement file is an object with a list \"joins\"");
            return std::nullopt;
        }
        if (const JsonMember* const odd = unknown_member<1>(*tree->object(), {"joins"})) {
            refuse(odd->value.at,
                   fmt::format("a refinement file has \"joins\" and nothing else, but this has "
                               "\"{}\"",
                               shown(odd->name)));
            return std::nullopt;
        }
        std::vector<Join> joins;
        for (const JsonValue& one : *list) {
            Join& join = joins.emplace_back();
            join.place = place_at(text_, one.at);
            const std::string why = read(one, join);
            if (why.empty()) continue;
            diagnostics_.error("bad-refinement", join.place, fmt::format("join {} {}", joins.size(), why))
                .hint(std::string(kWhatJoinsAre));
            return std::nullopt;
        }
        return joins;
    }

 private:
    void refuse(std::size_t at, std::string why) {
        diagnostics_.error("bad-refinement", place_at(text_, at), std::move(why));
    }

    // What is wrong with a join, as the rest of a sentence; empty: nothing.
    std::string read(const JsonValue& value, Join& join) const {
        if (value.object() == nullptr) return "is no object";
        const JsonList* parts = nullptr;
        for (const JsonMember& member : *value.object()) {
            if (member.name == kNumber) {
                const double* const number = member.value.number();
                if (number == nullptr || *number < 1.0 || *number > kLargestNumber ||
                    *number != std::floor(*number))
                    return "has a \"number\" that is no number of a suggestion";
                join.number = static_cast<int>(*number);
                continue;
            }
            const auto kind = kind_named(member.name);
            if (!kind) return fmt::format("is a \"{}\", which is no way to join", shown(member.name));
            if (parts != nullptr) return "is more than one: each has an object of its own";
            parts = member.value.list();
            if (parts == nullptr) return fmt::format("has a \"{}\" that is no list", member.name);
            join.kind = *kind;
        }
        if (parts == nullptr) return "does not say what it joins";
        return join.kind == JoinKind::merge ? read_corners(*parts, join) : read_panels(*parts, join);
    }

    static std::string read_panels(const JsonList& parts, Join& join) {
        const std::string_view kind = kJoinKindNames.at(static_cast<std::size_t>(join.kind));
        if (parts.size() != 2) return fmt::format("is a {} of {} panels instead of two", kind, parts.size());
        for (const JsonValue& part : parts) {
            if (part.text() == nullptr) return fmt::format("is a {} of what is no name of a panel", kind);
            join.parts.push_back({*part.text(), {}});
        }
        return {};
    }

    std::string read_corners(const JsonList& parts, Join& join) const {
        if (parts.size() < 2)
            return fmt::format("is a merge of {} corners instead of two or more", parts.size());
        for (const JsonValue& part : parts) {
            const JsonValue* const panel = part.member("panel");
            const JsonValue* const corner = part.member("corner");
            if (panel == nullptr || panel->text() == nullptr || corner == nullptr)
                return "is a merge of what has no \"panel\" or no \"corner\"";
            if (const JsonMember* const odd = unknown_member<2>(*part.object(), {"panel", "corner"}))
                return fmt::format("has a corner with \"{}\", which means nothing there", shown(odd->name));
            const JsonList* const at = corner->list();
            if (at == nullptr || at->size() != 2 || !is_length((*at)[0]) || !is_length((*at)[1]))
                return "has a \"corner\" that is no place: two numbers, as findings print it";
            join.parts.push_back({*panel->text(), in_mm({*(*at)[0].number(), *(*at)[1].number()})});
        }
        return {};
    }
    static bool is_length(const JsonValue& value) {
        return value.number() != nullptr && std::abs(*value.number()) <= kLargestCorner;
    }
    [[nodiscard]] Vec2 in_mm(Vec2 shown_at) const {
        const Vec2 off{shown_at.x, ruler_.y_down ? -shown_at.y : shown_at.y};
        return ruler_.origin + (1.0 / ruler_.per_mm) * off;
    }

    std::string_view text_;
    const Ruler& ruler_;
    Diagnostics& diagnostics_;
};

// To five decimals, and never -0.
double settled(double value) { return std::round(value * 1e5) / 1e5 + 0.0; }

}  // namespace

Vec2 corner_as_shown(const Ruler& ruler, Vec2 at) {
    const Vec2 off = ruler.per_mm * (at - ruler.origin);
    return {settled(off.x), settled(ruler.y_down ? -off.y : off.y)};
}

std::string write_refinement(const std::vector<Join>& joins, const Ruler& ruler) {
    std::string text = "{\n  \"joins\": [";
    for (std::size_t i = 0; i < joins.size(); ++i) {
        Json parts = Json::array();
        for (const JoinPart& part : joins[i].parts) {
            if (joins[i].kind == JoinKind::merge) {
                const Vec2 corner = corner_as_shown(ruler, part.corner);
                parts.push_back({{"panel", part.panel}, {"corner", {corner.x, corner.y}}});
            } else {
                parts.push_back(part.panel);
            }
        }
        text += fmt::format("{}\n    {{\"{}\": {}", i == 0 ? "" : ",",
                            kJoinKindNames.at(static_cast<std::size_t>(joins[i].kind)), parts.dump());
        if (joins[i].number > 0) text += fmt::format(", \"{}\": {}", kNumber, joins[i].number);
        text += "}";
    }
    return text + (joins.empty() ? "]\n}\n" : "\n  ]\n}\n");
}

std::optional<std::vector<Join>> read_refinement(const Source& source, const Ruler& ruler,
                                                 Diagnostics& diagnostics) {
    return Reader(source, ruler, diagnostics).run();
}

}  // namespace popup
