// The values of an element's parameters, as its row describes them.
#include <fmt/format.h>

#include <algorithm>

#include "base/text/nearest.h"
#include "input/text.h"
#include "input/xml/number.h"
#include "input/xml/path_text.h"
#include "input/xml/values.h"

namespace popup::xml {

std::optional<Argument> Values::argument(const Field& field, const ParameterInfo& parameter) {
    Argument made;
    made.place = field.place;
    if (field.node) made.tag_text = field.node.start_tag();
    switch (parameter.kind) {
        case ParameterKind::colour: {
            const std::optional<Color> value = color(&field);
            if (!value) return std::nullopt;
            made.value = *value;
            return made;
        }
        case ParameterKind::length:
        case ParameterKind::number: {
            const std::optional<Text> text = value_of(field, reporter_);
            if (!text || !read_number(*text, parameter, made)) return std::nullopt;
            return made;
        }
        case ParameterKind::choice: {
            const std::optional<Text> text = value_of(field, reporter_);
            if (!text || !read_choice(*text, parameter, made)) return std::nullopt;
            return made;
        }
        case ParameterKind::path:
            if (!read_path(field, parameter, made)) return std::nullopt;
            return made;
        case ParameterKind::points:
            read_points(field, made);
            return made;
    }
    return std::nullopt;
}

bool Values::read_number(const Text& text, const ParameterInfo& parameter, Argument& made) {
    const bool is_length = parameter.kind == ParameterKind::length;
    const std::optional<double> value = is_length ? length(text.decoded, parameter.name, text.place)
                                                  : number(text.decoded, parameter.name, text.place);
    if (!value) return false;
    made.place = text.place;
    made.text = tight(text);
    made.value = *value;
    if (*value >= parameter.least && *value <= parameter.most) return true;
    const double unit = is_length ? unit_.mm : 1.0;
    const std::string name = is_length ? " " + std::string(unit_.name) : std::string();
    reporter_.error(
        "bad-number", text.place,
        fmt::format("{} is {}{}, and must be from {} to {}{}", parameter.name, shown(trimmed(text.decoded)),
                    name, format_number(parameter.least / unit), format_number(parameter.most / unit), name));
    return false;
}

bool Values::read_choice(const Text& text, const ParameterInfo& parameter, Argument& made) {
    const std::string word = lower(trimmed(text.decoded));
    made.place = text.place;
    made.text = tight(text);
    const auto known = std::find(parameter.words.begin(), parameter.words.end(), word);
    if (known != parameter.words.end()) {
        made.value = std::string(*known);
        return true;
    }
    std::string words;
    for (const std::string_view one : parameter.words)
        words += (words.empty() ? "" : ", ") + std::string(one);
    reporter_
        .error("bad-choice", text.place,
               fmt::format("{} is '{}', which is not one of its words", parameter.name,
                           shown(trimmed(text.decoded))))
        .hint("known words are " + words);
    return false;
}

// Path data stands in the attribute d of a child element, or where any single value may.
bool Values::read_path(const Field& field, const ParameterInfo& parameter, Argument& made) {
    std::optional<Text> text;
    if (field.node) {
        Fields fields(field.node, Name::argument, reporter_);
        made.page = page(fields.find(Name::page), &made.page_text);
        const Field* d = fields.find(Name::d);
        if (d == nullptr) d = fields.find(Name::value);
        if (d != nullptr) {
            fields.refuse_text();
            text = value_of(*d, reporter_);
            if (!text) return false;
        } else if (!fields.texts().empty()) {
            text = fields.texts().front();
        }
    } else {
        text = value_of(field, reporter_);
    }
    if (!text) {
        reporter_.error("missing-value", field.place, fmt::format("'{}' is empty", parameter.name));
        return false;
    }
    made.text = tight(*text);
    DrawnPath path;
    const auto refusal = xml::read_path(trimmed(text->decoded), unit_, path);
    made.value = std::move(path);
    if (!refusal) return true;
    reporter_.error(refusal->too_large ? "document-too-large" : "bad-path", text->place,
                    fmt::format("the path data of {} {}", parameter.name, refusal->what));
    return false;
}

void Values::read_points(const Field& field, Argument& made) {
    std::vector<DesignPoint> list;
    if (field.node) {
        const Fields fields(field.node, Name::argument, reporter_);
        made.page = page(fields.find(Name::page), &made.page_text);
        points(fields, list);
    } else {
        points(field.text, list);
    }
    made.value = std::move(list);
}

}  // namespace popup::xml
