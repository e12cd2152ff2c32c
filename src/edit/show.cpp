// What a card is made of, in the words of people.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/text/json_text.h"
#include "edit/session.h"
#include "input/text.h"
#include "input/xml/number.h"

namespace popup {
namespace {

using Json = nlohmann::ordered_json;

class Shown {
 public:
    Shown(const Design& design, const CardFolds& card, const ShowOptions& options)
        : design_(design), options_(options), card_(card), children_(design.structures.size()) {
        for (std::size_t n = 0; n < design.structures.size(); ++n) {
            const auto owner = card_.standing[n].owner;
            if (owner) children_[*owner].push_back(n);
            pages_.push_back(info(n).glued ? ++glued_ : 0);
        }
    }

    std::string tree() const {
        std::string out;
        if (options_.id.empty()) {
            out += fmt::format("page, {} × {} {}{}\n", number(design_.width_mm), number(design_.height_mm),
                               design_.unit.name,
                               design_.opens_deg < 180.0
                                   ? fmt::format(", opens to {}°", xml::format_number(design_.opens_deg))
                                   : std::string());
        }
        for (const auto& [n, depth] : order()) {
            const std::string indent(2 * (depth + (options_.id.empty() ? 1 : 0)), ' ');
            out += indent + line(n) + "\n";
            if (const std::string names = folds(n); !names.empty())
                out.append(indent).append("    folds: ").append(names).append("\n");
        }
        return out;
    }

    Json json() const {
        Json elements = Json::array();
        for (const auto& [n, depth] : order()) elements.push_back(element(n));
        if (!options_.id.empty()) return {{"unit", design_.unit.name}, {"elements", std::move(elements)}};
        Json folds = Json::array();
        for (const CardFold& fold : card_.folds) folds.push_back(fold.name);
        return {{"file", design_.file},
                {"version", design_.version},
                {"unit", design_.unit.name},
                {"width", rounded(design_.width_mm)},
                {"height", rounded(design_.height_mm)},
                {"opens", design_.opens_deg},
                {"folds", std::move(folds)},
                {"plates", card_.plates},
                {"elements", std::move(elements)}};
    }

 private:
    [[nodiscard]] const ElementInfo& info(std::size_t n) const {
        return edit::Session::info_of(design_.structures[n]);
    }
    [[nodiscard]] double rounded(double mm) const {
        return std::round(mm / design_.unit.mm * 1e6) / 1e6 + 0.0;
    }
    // With three decimals: a person reads them.
    [[nodiscard]] static std::string short_number(double value) {
        return xml::format_number(std::round(value * 1e3) / 1e3);
    }
    [[nodiscard]] std::string number(double mm) const { return short_number(mm / design_.unit.mm); }

    // Structures with how deep they stand, what stands on one behind it.
    [[nodiscard]] std::vector<std::pair<std::size_t, std::size_t>> order() const {
        std::vector<std::pair<std::size_t, std::size_t>> made;
        std::vector<std::pair<std::size_t, std::size_t>> left;
        for (std::size_t n = design_.structures.size(); n-- > 0;) {
            const bool root =
                options_.id.empty() ? !card_.standing[n].owner : design_.structures[n].id == options_.id;
            if (root) left.emplace_back(n, 0);
        }
        while (!left.empty()) {
            const auto [n, depth] = left.back();
            left.pop_back();
            made.emplace_back(n, depth);
            for (auto child = children_[n].rbegin(); child != children_[n].rend(); ++child)
                left.emplace_back(*child, depth + 1);
        }
        return made;
    }

    [[nodiscard]] std::optional<std::vector<double>> measures(std::size_t n) const {
        const Standing& standing = card_.standing[n];
        return measures_of(info(n), standing.seen, 1,
                           edit::Session::points_of(design_.structures[n], standing.seen),
                           design_.structures[n].arguments);
    }

    [[nodiscard]] std::string value(const MeasureInfo& measure, double value) const {
        switch (measure.kind) {
            case MeasureKind::length:
                return number(value);
            case MeasureKind::angle:
                return short_number(value) + "°";
            case MeasureKind::choice:
                break;
        }
        return std::string(measure.words[value > 0.5 ? 1 : 0]);
    }

    [[nodiscard]] bool is_said(const MeasureInfo& measure, double value) const {
        if (measure.relative) return false;
        if (options_.all || measure.said == Said::always) return true;
        return measure.said == Said::unless_zero && std::abs(value) >= 5e-4;
    }

    // "bird (v-fold) on gutter: at 20, width 40, …".
    [[nodiscard]] std::string line(std::size_t n) const {
        const Structure& one = design_.structures[n];
        const Standing& standing = card_.standing[n];
        std::string text = fmt::format("{} ({})", one.id, one.type);
        text += standing.on.empty() ? " stands on nothing" : " on " + standing.on;
        const auto values = measures(n);
        bool first = true;
        for (std::size_t i = 0; values && i < values->size(); ++i) {
            const MeasureInfo& measure = info(n).measures[i];
            if (!is_said(measure, (*values)[i])) continue;
            text += fmt::format("{} {} {}", first ? ":" : ",", measure.name, value(measure, (*values)[i]));
            first = false;
        }
        for (std::size_t i = 0; i < one.arguments.size(); ++i) {
            const std::string_view name = info(n).parameters[i].name;
            const auto& given = one.arguments[i].value;
            std::string said;
            if (const auto* word = std::get_if<std::string>(&given)) said = *word;
            if (const auto* size = std::get_if<double>(&given))
                said =
                    info(n).parameters[i].kind == ParameterKind::length ? number(*size) : short_number(*size);
            if (const auto* path = std::get_if<DrawnPath>(&given)) said = drawn(*path);
            if (const auto* color = std::get_if<Color>(&given); color && options_.all)
                said = to_string(*color);
            if (said.empty()) continue;
            text += fmt::format("{} {} {}", first ? ":" : ",", name, said);
            first = false;
        }
        if (options_.all) text += defaults(n);
        if (info(n).glued) text += fmt::format("; page {}", pages_[n]);
        return text;
    }

    // "; by default radius 25, rivet 3": the sizes that are not given. Whether the element uses them depends
    // on what is: a disc with an outline has no radius.
    [[nodiscard]] std::string defaults(std::size_t n) const {
        std::string text;
        const auto& arguments = design_.structures[n].arguments;
        for (std::size_t i = 0; i < info(n).parameters.size(); ++i) {
            const ParameterInfo& parameter = info(n).parameters[i];
            const bool is_length = parameter.kind == ParameterKind::length;
            if (parameter.required || (i < arguments.size() && arguments[i].given())) continue;
            if (!is_length && parameter.kind != ParameterKind::number) continue;
            text += fmt::format("{} {} {}", text.empty() ? "; by default" : ",", parameter.name,
                                is_length ? number(parameter.standard) : short_number(parameter.standard));
        }
        return text;
    }

    [[nodiscard]] std::string drawn(const DrawnPath& path) const {
        Box box;
        for (const Polygon& area : path.inside.areas) {
            for (const Vec2 p : area.outer) box.extend(p);
        }
        return fmt::format("of {} × {}", number(box.width()), number(box.height()));
    }

    [[nodiscard]] std::string folds(std::size_t n) const {
        std::string text;
        for (const FoldInfo& fold : info(n).folds) {
            const bool seam = info(n).glued && fold.on_left != fold.on_right;
            text += fmt::format("{}{}{}", text.empty() ? "" : ", ", fold_name(design_.structures[n].id, fold),
                                seam ? " (seam)" : "");
        }
        return text;
    }

    [[nodiscard]] Json element(std::size_t n) const {
        const Structure& one = design_.structures[n];
        const Standing& standing = card_.standing[n];
        Json made{{"id", one.id},
                  {"type", one.type},
                  {"line", one.place.line},
                  {"on", standing.on.empty() ? Json() : Json(standing.on)},
                  {"page", info(n).glued ? Json(pages_[n]) : Json()}};
        Json& all = made["measures"] = Json::object();
        const auto values = measures(n);
        for (std::size_t i = 0; values && i < values->size(); ++i) {
            const MeasureInfo& measure = info(n).measures[i];
            if (measure.relative) continue;
            Json& value = all[std::string(measure.name)];
            if (measure.kind == MeasureKind::choice) {
                value = measure.words[(*values)[i] > 0.5 ? 1 : 0];
            } else {
                value = measure.kind == MeasureKind::length ? rounded((*values)[i])
                                                            : std::round((*values)[i] * 1e6) / 1e6 + 0.0;
            }
        }
        Json& given = made["values"] = Json::object();
        for (std::size_t i = 0; i < one.arguments.size(); ++i) {
            const auto& what = one.arguments[i].value;
            const std::string name(info(n).parameters[i].name);
            if (const auto* word = std::get_if<std::string>(&what)) given[name] = *word;
            if (const auto* color = std::get_if<Color>(&what)) given[name] = to_string(*color);
            if (const auto* path = std::get_if<DrawnPath>(&what)) given[name] = path->text;
            if (const auto* size = std::get_if<double>(&what)) {
                const bool is_length = info(n).parameters[i].kind == ParameterKind::length;
                given[name] = is_length ? rounded(*size) : *size;
            }
        }
        Json& points = made["points"] = Json::object();
        for (std::size_t i = 0; i < one.points.size(); ++i)
            points[std::string(info(n).points[i].letter)] = {rounded(one.points[i].at.x),
                                                             rounded(one.points[i].at.y)};
        Json& folds = made["folds"] = Json::array();
        for (const FoldInfo& fold : info(n).folds) {
            folds.push_back({{"name", fold_name(one.id, fold)},
                             {"seam", info(n).glued && fold.on_left != fold.on_right}});
        }
        Json& plates = made["plates"] = Json::array();
        for (const PlateInfo& plate : info(n).plates) plates.push_back(plate_name(one.id, plate));
        Json& carries = made["carries"] = Json::array();
        for (const std::size_t child : children_[n]) carries.push_back(design_.structures[child].id);
        return made;
    }

    const Design& design_;
    const ShowOptions& options_;
    const CardFolds& card_;
    std::vector<std::vector<std::size_t>> children_;
    std::vector<int> pages_;
    int glued_ = 0;
};

bool is_there(const Design& design, const ShowOptions& options, Diagnostics& diagnostics) {
    if (options.id.empty() || std::any_of(design.structures.begin(), design.structures.end(),
                                          [&](const Structure& one) { return one.id == options.id; }))
        return true;
    return edit::Session(design, design.file, {}, diagnostics).find(options.id).has_value();
}

}  // namespace

std::optional<std::string> show_tree(const Design& design, const ShowOptions& options,
                                     Diagnostics& diagnostics) {
    return show_tree(design, folds_of_card(design), options, diagnostics);
}

std::optional<std::string> show_tree(const Design& design, const CardFolds& card, const ShowOptions& options,
                                     Diagnostics& diagnostics) {
    if (!is_there(design, options, diagnostics)) return std::nullopt;
    return Shown(design, card, options).tree();
}

std::optional<std::string> show_json(const Design& design, const ShowOptions& options,
                                     Diagnostics& diagnostics) {
    if (!is_there(design, options, diagnostics)) return std::nullopt;
    const CardFolds card = folds_of_card(design);
    return json_text(Shown(design, card, options).json());
}

}  // namespace popup
