// The values of an element's parameters, as its row describes them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
            const std::optional<Text> text = value_of(field, reporter_);
            const std::optional<Color> value = text ? color(*text, field.word()) : std::nullopt;
            if (!value) return std::nullopt;
            made.value = *value;
            made.text = tight(*text);
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
        const Field* href = fields.find(Name::href);
        const Field* d = fields.find(Name::d);
        if (href != nullptr && d == nullptr) return read_outline(fields, *href, parameter, made);
        if (href != nullptr) {
            reporter_.error("bad-path", href->place,
                            fmt::format("this {} has both path data and a file", parameter.name));
            return false;
        }
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
    if (refusal) {
        made.value = std::move(path);
        reporter_.error(refusal->too_large ? "document-too-large" : "bad-path", text->place,
                        fmt::format("the path data of {} {}", parameter.name, refusal->what));
        return false;
    }
    tell_slits(path, parameter, text->place);
    made.value = std::move(path);
    return true;
}

void Values::tell_slits(const DrawnPath& path, const ParameterInfo& parameter, Place place) {
    const std::vector<std::vector<Vec2>> slits = slits_of(path, parameter.name != "outline");
    if (slits.empty()) return;
    const Vec2 from = slits.front().front();
    const Vec2 to = slits.front().back();
    const std::string first = fmt::format("({}, {}) mm to ({}, {}) mm", format_number(from.x),
                                          format_number(from.y), format_number(to.x), format_number(to.y));
    reporter_
        .warning("slit-not-cut", place,
                 slits.size() == 1
                     ? fmt::format("{} has a slit that encloses nothing and is not cut, from {}",
                                   parameter.name, first)
                     : fmt::format("{} has {} slits that enclose nothing and are not cut, the first from {}",
                                   parameter.name, slits.size(), first))
        .hint("draw a slit that is to be cut as a narrow hole or notch");
}

bool Values::read_outline_place(const Fields& fields, OutlinePlace& place) {
    for (const Name name : {Name::x, Name::y, Name::width, Name::height, Name::rotate}) {
        const Field* field = fields.find(name);
        if (field == nullptr) continue;
        const std::optional<double> value = name == Name::rotate ? number(*field) : length(*field);
        if (!value) return false;
        const bool extent = name == Name::width || name == Name::height;
        const bool turn = name == Name::rotate;
        if ((extent && !(*value > 0.0 && *value <= kLargestPage)) || (turn && !(std::abs(*value) <= 360.0))) {
            reporter_.error(
                "bad-number", field->place,
                turn
                    ? fmt::format("rotate is {}, and must be from -360 to 360 degrees", format_number(*value))
                    : fmt::format("{} is {} mm, and must be above 0 and at most {} mm", field->word(),
                                  format_number(*value), format_number(kLargestPage)));
            return false;
        }
        if (name == Name::x) place.at.x = *value;
        if (name == Name::y) place.at.y = *value;
        if (name == Name::width) place.width_mm = *value;
        if (name == Name::height) place.height_mm = *value;
        if (turn) place.rotate_deg = *value;
    }
    const Field* field = fields.find(Name::mirror);
    const std::optional<Text> text = field != nullptr ? value_of(*field, reporter_) : std::nullopt;
    if (field == nullptr) return true;
    if (!text) return false;
    const std::string word = lower(trimmed(text->decoded));
    place.mirror = word == "yes";
    if (word == "yes" || word == "no") return true;
    reporter_
        .error("bad-choice", text->place,
               fmt::format("mirror is '{}', which is not one of its words", shown(trimmed(text->decoded))))
        .hint("known words are no, yes");
    return false;
}

// The closed lines of a drawing, placed as a picture is.
bool Values::read_outline(const Fields& fields, const Field& href, const ParameterInfo& parameter,
                          Argument& made) {
    const std::optional<Text> text = value_of(href, reporter_);
    OutlinePlace place;
    if (!text || !read_outline_place(fields, place)) return false;
    POPUP_INVARIANT(files_ != nullptr);
    const std::string name(trimmed(text->decoded));
    PictureRefusal refusal;
    const std::string* file = files_->text(name, "outlines", refusal);
    if (file == nullptr) {
        reporter_.error(refusal.code, text->place, refusal.message).hint(refusal.hint);
        return false;
    }
    OutlineDrawing drawing;
    const std::string trouble = read_outline_drawing(name, *file, drawing);
    if (!trouble.empty()) {
        reporter_.error("outline-unreadable", text->place, fmt::format("\"{}\": {}", shown(name), trouble))
            .hint("name an SVG drawing with closed lines, such as popupc trace writes");
        return false;
    }
    DrawnPath path;
    const auto fault = place_outline(drawing, place, path);
    if (fault) {
        reporter_.error(fault->too_large ? "document-too-large" : "outline-unreadable", text->place,
                        fmt::format("what \"{}\" draws {}", shown(name), fault->what));
        return false;
    }
    if (parameter.name == "outline" && path.inside.areas.size() != 1) {
        reporter_
            .error("outline-unreadable", text->place,
                   fmt::format("\"{}\" draws {} shapes, and an outline is one", shown(name),
                               path.inside.areas.size()))
            .hint("popupc trace --largest writes a single silhouette");
        return false;
    }
    tell_slits(path, parameter, text->place);
    path.text = path_text(path, unit_);
    made.value = std::move(path);
    return true;
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
