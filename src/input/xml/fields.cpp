#include "input/xml/fields.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/text/nearest.h"
#include "input/text.h"

namespace popup::xml {
namespace {

// Where text has a meaning; elsewhere it is unknown markup.
bool takes_text(Name context) {
    switch (context) {
        case Name::outerpoints:
        case Name::point:
        case Name::begin:
        case Name::end:
        case Name::drawnline:
        case Name::text:
        case Name::parentplate:
        case Name::argument:
        case Name::value:
            return true;
        default:
            return is_scalar(context);
    }
}

// What belongs to XML itself, or to a validator, is of no concern here.
bool is_foreign(std::string_view attribute) {
    return attribute == "xmlns" || attribute.starts_with("xmlns:") || attribute.starts_with("xml:") ||
           attribute.starts_with("xsi:");
}

// What the sheets lack because an element of such a place is not known.
std::string_view missing_for(Name place) {
    if (place == Name::drawnlinelist) return "; nothing is printed for it";
    if (place == Name::structurelist) return "; nothing is cut or folded for it";
    return "";
}

// After this many, Diagnostics only counts: then hints need not be looked for.
constexpr std::size_t kShownUnknowns = 100;

}  // namespace

Diagnostic& Reporter::add(Severity severity, std::string_view code, Place place, std::string message) {
    Diagnostic& made = diagnostics_.add(severity, code, place, std::move(message));
    if (structure_ != kNone) about_.emplace_back(&made, structure_);
    return made;
}

Diagnostic& Reporter::error(std::string_view code, Place place, std::string message) {
    return add(Severity::error, code, place, std::move(message));
}

Diagnostic& Reporter::warning(std::string_view code, Place place, std::string message) {
    return add(Severity::warning, code, place, std::move(message));
}

void Reporter::unknown_name(Name context, std::string_view name, Place place, bool attribute) {
    const Severity severity = strict_ ? Severity::error : Severity::warning;
    if (++unknown_ > kShownUnknowns) {
        add(severity, "unknown-markup", place, {});
        return;
    }
    const Name home = home_of(context, name);
    Diagnostic& made =
        add(severity, "unknown-markup", place,
            fmt::format("the {} '{}' is not known in '{}'{}", attribute ? "attribute" : "element",
                        shown(name), canonical(context),
                        attribute ? "" : missing_for(home == Name::drawnlinelist ? home : context)));
    if (home != Name::unknown) {
        made.hint(fmt::format("'{}' belongs in '{}'", shown(name), canonical(home)));
        return;
    }
    const std::vector<std::string> near = nearest(lower(name), names_in(context), 1);
    if (!near.empty()) made.hint(fmt::format("perhaps '{}' is meant", near.front()));
}

void Reporter::value_of_others(const ElementInfo& info, std::string_view name, Place place, bool attribute) {
    const Severity severity = strict_ ? Severity::error : Severity::warning;
    if (++unknown_ > kShownUnknowns) {
        add(severity, "unknown-markup", place, {});
        return;
    }
    Diagnostic& made = add(severity, "unknown-markup", place,
                           fmt::format("the {} '{}' has no meaning in a structure of type {}",
                                       attribute ? "attribute" : "element", shown(name), info.name));
    // Who writes a colour wants to know which there are; names are too alike to guess one of them.
    const bool colour = name.find("color") != std::string_view::npos;
    std::vector<std::string_view> own;
    for (const ParameterInfo& parameter : info.parameters) {
        if (!colour || parameter.kind == ParameterKind::colour) own.push_back(parameter.name);
    }
    if (own.empty()) {
        made.hint("such a structure has no values but its points");
        return;
    }
    std::string list;
    for (std::size_t i = 0; i < own.size(); ++i) {
        if (i > 0) list += i + 1 == own.size() ? " and " : ", ";
        list += own[i];
    }
    made.hint(fmt::format("it has {}", list));
}

void Reporter::unknown_text(Name context, const Text& text) {
    const Severity severity = strict_ ? Severity::error : Severity::warning;
    if (++unknown_ > kShownUnknowns) {
        add(severity, "unknown-markup", text.place, {});
        return;
    }
    add(severity, "unknown-markup", text.place,
        fmt::format("the text '{}' has no meaning in '{}'", shown(trimmed(text.decoded)),
                    canonical(context)));
}

void Reporter::twice(std::string_view name, Place place, Place first) {
    Diagnostic& made =
        error("duplicate-value", place,
              fmt::format("'{}' is given twice; the first is on line {}", shown(name), first.line));
    if (find_parameter_name(lower(name)) == "hole" || find_parameter_name(lower(name)) == "window")
        made.hint("put the path data of both behind one another into one d: each of its subpaths is one");
}

void Reporter::in_parts(std::string_view name, const std::vector<Text>& texts) {
    error("duplicate-value", texts[1].place,
          fmt::format("the text of '{}' is in {} parts, parted by a comment, CDATA or an element",
                      shown(name), texts.size()))
        .hint("write the text in one piece; a comment can stand before or after the element");
}

void Reporter::name_structures(const std::vector<Structure>& structures) {
    for (const auto& [diagnostic, n] : about_) diagnostic->about(structures[n].id);
}

Fields::Fields(Node node, Name context, Reporter& reporter)
    : node_(node), context_(context), reporter_(reporter) {
    fields_.reserve(6);  // what a structure has
    for (const Attribute& attribute : node.attributes()) {
        std::string_view parameter;
        const Name name = name_of(attribute.name, parameter);
        if (name == Name::unknown || repeats(context, name)) {
            if (!is_foreign(attribute.name))
                reporter.unknown_name(context, attribute.name, attribute.place, true);
        } else if (const Field* first = find(name, parameter)) {
            reporter.twice(attribute.name, attribute.place, first->place);
        } else {
            fields_.push_back({name, attribute.place, attribute.value, {}, parameter});
        }
    }
    for (Node child = node.first_child(); child; child = child.next_sibling()) {
        const Name name = wants(child.name(), child.place());
        if (name != Name::unknown) add(name, child);
    }
    texts_ = node.texts();
    if (!takes_text(context)) refuse_text();
}

Name Fields::name_of(std::string_view spelling, std::string_view& parameter) const {
    const Name name = find_name(context_, spelling);
    if (name != Name::unknown || (context_ != Name::structure && context_ != Name::folds)) return name;
    parameter = find_parameter_name(spelling);
    return parameter.empty() ? Name::unknown : Name::argument;
}

Name Fields::wants(std::string_view spelling, Place place) {
    std::string_view parameter;
    const Name name = name_of(spelling, parameter);
    if (name == Name::unknown) {
        reporter_.unknown_name(context_, spelling, place, false);
        return Name::unknown;
    }
    if (const Field* first = find(name, parameter)) {
        reporter_.twice(spelling, place, first->place);
        return Name::unknown;
    }
    return name;
}

void Fields::add(Name name, Node child) {
    if (repeats(context_, name)) {
        repeated_.push_back(child);
    } else {
        std::string_view parameter;
        if (name == Name::argument) parameter = find_parameter_name(child.name());
        fields_.push_back({name, child.place(), {}, child, parameter});
    }
}

const Field* Fields::find(Name name) const { return find(name, {}); }

const Field* Fields::find(std::string_view parameter) const {
    const auto found = std::find_if(fields_.begin(), fields_.end(),
                                    [&](const Field& field) { return field.word() == parameter; });
    return found == fields_.end() ? nullptr : &*found;
}

const Field* Fields::find(Name name, std::string_view parameter) const {
    const auto found = std::find_if(fields_.begin(), fields_.end(), [&](const Field& field) {
        return field.name == name && field.parameter == parameter;
    });
    return found == fields_.end() ? nullptr : &*found;
}

void Fields::refuse_text() {
    for (const Text& text : texts_) reporter_.unknown_text(context_, text);
    texts_.clear();
}

std::optional<Text> value_of(const Field& field, Reporter& reporter) {
    Text text = field.text;
    if (field.node) {
        const Fields inner(field.node, field.name, reporter);
        std::vector<Text> values(inner.texts().begin(), inner.texts().end());
        if (values.size() > 1) {
            reporter.in_parts(field.word(), values);
            return std::nullopt;
        }
        // <x value="1"/>, or even <x><value>1</value></x>; `value` holds no further fields, so this ends.
        if (const Field* value = inner.find(Name::value)) {
            const std::optional<Text> nested = value_of(*value, reporter);
            if (!nested) return std::nullopt;
            values.push_back(*nested);
        }
        if (values.size() > 1) {
            reporter.twice(field.word(), values[1].place, values[0].place);
            return std::nullopt;
        }
        text = values.empty() ? Text{} : values.front();
    }
    if (trimmed(text.decoded).empty()) {
        reporter.error("missing-value", field.place, fmt::format("'{}' is empty", field.word()));
        return std::nullopt;
    }
    return text;
}

}  // namespace popup::xml
