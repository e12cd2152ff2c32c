#include "lsp/xml_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "input/text.h"

namespace popup::lsp {

using xml::Name;

namespace {

Span without_blanks(std::string_view text, Span at) {
    while (at.begin < at.end && is_blank(text[at.begin])) ++at.begin;
    while (at.end > at.begin && is_blank(text[at.end - 1])) --at.end;
    return at;
}

// Adds the value, if it names a structure.
void add_naming(const MarkedText& text, int element, Name what, Span value, std::vector<Naming>& into) {
    if (what != Name::page && what != Name::on) return;
    value = without_blanks(text.text, value);
    const std::string_view said = text.word(value);
    Span id = value;
    if (what == Name::on) id.end = value.begin + std::min(said.rfind('.'), said.size());
    const std::string_view name = text.word(id);
    if (!is_id(name) || name == kBasePage || (what == Name::on && said == kGutter)) return;
    into.push_back({element, what, value, id});
}

}  // namespace

MarkedText marked(std::string_view text) { return {text, read_markup(text)}; }

std::span<const MarkupAttribute> MarkedText::attributes(int number) const {
    const MarkupElement& one = element(number);
    return std::span(markup.attributes).subspan(one.first, one.count);
}

const MarkupAttribute* MarkedText::attribute(int number, Name name) const {
    for (const MarkupAttribute& one : attributes(number)) {
        if (meaning(element(number).what, word(one.name)) == name) return &one;
    }
    return nullptr;
}

int MarkedText::structure_of(int number) const {
    while (number >= 0 && element(number).what != Name::structure) number = element(number).parent;
    return number;
}

std::optional<Span> MarkedText::value(int number, Name name) const {
    if (const MarkupAttribute* found = attribute(number, name)) return found->value;
    for (const int child : markup.children(number)) {
        const MarkupElement& one = element(child);
        if (one.what != name || one.empty || one.end_name.size() == 0) continue;
        std::size_t begin = one.tag.end;
        std::size_t end = one.end_name.begin - 2;
        while (begin < end && is_blank(text[begin])) ++begin;
        while (end > begin && is_blank(text[end - 1])) --end;
        return Span{begin, end};
    }
    return std::nullopt;
}

const ElementInfo* MarkedText::row(int structure) const {
    if (structure < 0) return nullptr;
    const auto type = value(structure, Name::type);
    return type ? find_element(trimmed(word(*type))) : nullptr;
}

std::vector<int> MarkedText::structures() const {
    std::vector<int> found;
    for (std::size_t i = 0; i < markup.elements.size(); ++i) {
        if (markup.elements[i].what == Name::structure) found.push_back(static_cast<int>(i));
    }
    return found;
}

const ParameterInfo* parameter_of(const ElementInfo* info, std::string_view spelling) {
    std::string_view name = xml::find_parameter_name(spelling);
    // The four colours are words of the table, too.
    if (name.empty()) name = xml::canonical(xml::find_name(Name::structure, spelling));
    const auto in = [name](const ElementInfo& row) -> const ParameterInfo* {
        const auto number = find_parameter(row, name);
        return number ? &row.parameters[*number] : nullptr;
    };
    if (info != nullptr) {
        if (const ParameterInfo* found = in(*info)) return found;
    }
    for (const ElementInfo& row : element_table()) {
        if (const ParameterInfo* found = in(row)) return found;
    }
    return nullptr;
}

bool is_color(Name name, std::string_view spelling, const ElementInfo* info) {
    constexpr std::array kColors{Name::leftcolor,     Name::rightcolor, Name::lefttabcolor,
                                 Name::righttabcolor, Name::color,      Name::fill};
    if (std::find(kColors.begin(), kColors.end(), name) != kColors.end()) return true;
    if (name != Name::argument) return false;
    const ParameterInfo* parameter = parameter_of(info, spelling);
    return parameter != nullptr && parameter->kind == ParameterKind::colour;
}

std::string takes(const ParameterInfo& parameter) {
    switch (parameter.kind) {
        case ParameterKind::colour:
            return "a colour";
        case ParameterKind::length:
            return fmt::format(
                "a length, from {:g} to {:g} mm, in the document's unit{}", parameter.least, parameter.most,
                parameter.required ? "" : fmt::format("; {:g} mm where none is given", parameter.standard));
        case ParameterKind::number:
            return fmt::format(
                "a number, from {:g} to {:g}{}", parameter.least, parameter.most,
                parameter.required ? "" : fmt::format("; {:g} where none is given", parameter.standard));
        case ParameterKind::choice: {
            std::string words;
            for (const std::string_view word : parameter.words)
                words += fmt::format("{}`{}`", words.empty() ? "" : ", ", word);
            return fmt::format("one of {}; the first where none is given", words);
        }
        case ParameterKind::path:
            return "SVG path data in the document's unit, y up";
        case ParameterKind::points:
            return "a list of points";
    }
    return {};
}

std::string point_markdown(const ElementInfo& info, std::size_t number) {
    const PointInfo& point = info.points[number];
    std::string text = fmt::format(
        "**{}**, point {} of {} of {} {}: ", point.letter, number + 1, info.points.size(),
        std::string_view("aeiou").find(info.name.front()) == std::string_view::npos ? "a" : "an", info.name);
    text += point.side == 'L'   ? "on the left"
            : point.side == 'R' ? "on the right"
                                : "on the fold, or of both sides";
    text += point.page == PointPage::extra ? ", on the page of its own piece"
                                           : ", on the page of what it stands on";
    if (number < info.partners.size()) {
        const auto partner = static_cast<std::size_t>(info.partners[number]);
        if (partner != number && partner < info.points.size())
            text += fmt::format("; its partner is {}", info.points[partner].letter);
    }
    return text;
}

std::string row_markdown(const ElementInfo& info) {
    std::string text = fmt::format("**{}**{}: {}\n\n{}", info.name,
                                   info.code >= 0 ? fmt::format(" (type {})", info.code) : "", info.about,
                                   info.glued ? "Glued on: it brings a piece and a page of its own."
                                              : "Cut from the paper that it stands on.");
    if (!info.points.empty()) {
        text += "\n\nPoints: ";
        PointPage page = PointPage::fold;
        for (std::size_t i = 0; i < info.points.size(); ++i) {
            const PointInfo& point = info.points[i];
            if (point.page != page) text += "; on its own page";
            page = point.page;
            text += fmt::format("{}{}{}", i == 0 ? "" : " ", point.letter,
                                point.side == 'L'   ? " (left)"
                                : point.side == 'R' ? " (right)"
                                                    : "");
        }
    }
    if (!info.folds.empty()) {
        text += "\n\nFolds that others can stand on: ";
        for (std::size_t i = 0; i < info.folds.size(); ++i)
            text += fmt::format("{}{}", i == 0 ? "" : ", ", info.folds[i].name);
    }
    if (!info.parameters.empty()) text += "\n";
    for (const ParameterInfo& parameter : info.parameters) {
        text += fmt::format("\n* `{}`{}: {}; {}", parameter.name, parameter.required ? " (required)" : "",
                            parameter.about, takes(parameter));
    }
    return text;
}

std::vector<std::string> ids_of(const MarkedText& text) {
    std::vector<std::string> ids;
    for (const int structure : text.structures()) {
        const auto value = text.value(structure, Name::id);
        ids.push_back(value && value->size() > 0 ? std::string(trimmed(text.word(*value)))
                                                 : fmt::format("e{}", ids.size() + 1));
    }
    return ids;
}

std::vector<Naming> namings(const MarkedText& text) {
    std::vector<Naming> made;
    for (std::size_t i = 0; i < text.markup.elements.size(); ++i) {
        const int element = static_cast<int>(i);
        const MarkupElement& one = text.markup.elements[i];
        for (const MarkupAttribute& attribute : text.attributes(element))
            add_naming(text, element, meaning(one.what, text.word(attribute.name)), attribute.value, made);
        if (!one.empty && one.end_name.size() > 0)
            add_naming(text, element, one.what, {one.tag.end, one.end_name.begin - 2}, made);
    }
    return made;
}

std::vector<NamedPlace> places_before(const MarkedText& text, int structure, bool plates) {
    std::vector<NamedPlace> made;
    if (plates) {
        for (const std::string_view name : kPagePlates)
            made.push_back({std::string(name), fmt::format("the {} half of the page", name.substr(5))});
    } else {
        made.push_back({std::string(kGutter), "the gutter of the page"});
    }
    const std::vector<int> all = text.structures();
    const std::vector<std::string> ids = ids_of(text);
    for (std::size_t i = 0; i < all.size() && all[i] != structure; ++i) {
        const ElementInfo* info = text.row(all[i]);
        if (info == nullptr) continue;
        if (plates) {
            for (const PlateInfo& plate : info->plates)
                made.push_back({plate_name(ids[i], plate), fmt::format("a plate of \"{}\"", ids[i])});
            continue;
        }
        for (const FoldInfo& fold : info->folds) {
            const bool seam = info->glued && fold.on_left != fold.on_right;
            made.push_back({fold_name(ids[i], fold),
                            fmt::format("the {} {} of \"{}\"", fold.name, seam ? "seam" : "fold", ids[i])});
        }
    }
    return made;
}

std::string_view version_of(const MarkedText& text) {
    constexpr std::string_view kFirst = "2.0";
    if (text.markup.elements.empty()) return kFirst;
    const auto said = text.value(0, Name::version);
    return said && said->size() > 0 ? trimmed(text.word(*said)) : kFirst;
}

}  // namespace popup::lsp
