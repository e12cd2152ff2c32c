// Documents that begin: empty, with some elements, or as a template has it.
#include <fmt/format.h>

#include <algorithm>

#include "edit/session.h"
#include "edit/templates.h"
#include "input/design_limits.h"
#include "input/xml/number.h"
#include "input/xml/read.h"
#include "input/xml/units.h"
#include "mechanism/measures.h"
#include "output/xml.h"
#include "popup/edit.h"

namespace popup {
namespace {

constexpr double kCardWidthMm = 200.0;
constexpr double kCardHeightMm = 140.0;

// The first line of a template is a comment that says what it is.
std::string_view about_of(std::string_view text) {
    const std::size_t begin = text.find("<!-- ");
    const std::size_t end = text.find(" -->");
    return begin == std::string_view::npos ? std::string_view() : text.substr(begin + 5, end - begin - 5);
}

void scale(std::vector<DesignPoint>& points, double by) {
    for (DesignPoint& point : points) point.at = by * point.at;
}

// Everything as much larger; pages too.
void scale(Design& design, double by) {
    const Placed larger{by, 0, 0, by, 0, 0};
    design.width_mm *= by;
    design.height_mm *= by;
    for (Structure& one : design.structures) {
        const ElementInfo& info = edit::Session::info_of(one);
        scale(one.points, by);
        one.fold.begin.at = by * one.fold.begin.at;
        one.fold.end.at = by * one.fold.end.at;
        if (one.plate) one.plate->at.at = by * one.plate->at.at;
        for (std::size_t i = 0; i < one.arguments.size(); ++i) {
            Argument& argument = one.arguments[i];
            auto* length = std::get_if<double>(&argument.value);
            if (length != nullptr && info.parameters[i].kind == ParameterKind::length) *length *= by;
            if (is_drawn(argument)) move_argument(argument, larger);
        }
    }
    for (DrawnLine& line : design.lines) scale(line.points, by);
    for (DrawnPrint& print : design.prints) {
        print.at.at = by * print.at.at;
        if (auto* text = std::get_if<DrawnText>(&print.what)) text->height_mm *= by;
        if (auto* area = std::get_if<DrawnArea>(&print.what)) {
            Argument shape;
            shape.value = std::move(area->shape);
            move_argument(shape, larger);
            area->shape = std::get<DrawnPath>(std::move(shape.value));
        }
    }
}

std::string of_template(const CardTemplate& pattern, const NewCard& wanted) {
    if (!wanted.width_mm) return std::string(pattern.text);
    Diagnostics unheard;
    auto design = xml::read({std::string(pattern.name) + ".xml", std::string(pattern.text)}, {}, unheard);
    POPUP_INVARIANT(design);
    scale(*design, std::min(*wanted.width_mm / design->width_mm, *wanted.height_mm / design->height_mm));
    design->width_mm = *wanted.width_mm;
    design->height_mm = *wanted.height_mm;
    if (const Unit* unit = xml::find_unit(wanted.unit)) design->unit = *unit;
    return write_document(*design);
}

}  // namespace

std::span<const CardTemplate> card_templates() {
    static const std::vector<CardTemplate> all = [] {
        std::vector<CardTemplate> made;
        for (const edit::TemplateFile& file : edit::template_files()) {
            made.push_back({file.name.substr(0, file.name.rfind('.')), about_of(file.text), file.text});
        }
        return made;
    }();
    return all;
}

std::optional<std::string> new_document(const NewCard& wanted, Diagnostics& diagnostics) {
    for (const std::optional<double>& mm : {wanted.width_mm, wanted.height_mm}) {
        if (!mm || (*mm >= kSmallestPage && *mm <= kLargestPage)) continue;
        diagnostics.error("page-size", {},
                          fmt::format("a card of {} mm on a side cannot be made; {} to {} mm can", *mm,
                                      kSmallestPage, kLargestPage));
        return std::nullopt;
    }
    if (!wanted.pattern.empty()) {
        const auto all = card_templates();
        const auto found = std::find_if(all.begin(), all.end(),
                                        [&](const CardTemplate& one) { return one.name == wanted.pattern; });
        POPUP_INVARIANT(found != all.end());
        return of_template(*found, wanted);
    }
    const double height = wanted.height_mm.value_or(kCardHeightMm);
    const Unit* given = wanted.width_mm ? xml::find_unit(wanted.unit) : nullptr;
    const Unit unit = given != nullptr ? *given : Unit{"mm", 1.0};
    const std::string text = fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<popup version=\"3.0\" units=\"{}\">\n"
        "  <mainpage width=\"{}\" height=\"{}\"/>\n  <structurelist>\n  </structurelist>\n</popup>\n",
        unit.name, xml::format_number(wanted.width_mm.value_or(kCardWidthMm) / unit.mm),
        xml::format_number(height / unit.mm));
    if (wanted.with.empty()) return text;
    // Each has its own stretch of the gutter, from its end to its begin: the first stands furthest back. On a
    // narrow card a larger one would stick out when it is closed.
    constexpr double kRoomOfWidth = 1.25;
    std::vector<EditLine> edits;
    const double width = wanted.width_mm.value_or(kCardWidthMm);
    const double room = height / static_cast<double>(wanted.with.size());
    double at = 0.5 * height - 0.5 * room;
    for (const std::string& type : wanted.with) {
        const ElementInfo* info = find_element(type);
        EditLine& edit = edits.emplace_back();
        edit.words = {"add", type};
        if (info != nullptr) {
            edit.words.insert(
                edit.words.end(),
                {"--room", fmt::format("{}mm", std::min({1.6 * room, height, kRoomOfWidth * width}))});
            const char* place = find_measure(*info, "at") ? "--at" : find_measure(*info, "y") ? "--y" : "";
            if (*place != '\0') edit.words.insert(edit.words.end(), {place, fmt::format("{}mm", at)});
        }
        at -= room;
    }
    Diagnostics of_edits(diagnostics.file());
    const auto edited = edit_document({diagnostics.file(), text}, edits, {}, of_edits, diagnostics);
    for (const Diagnostic& one : of_edits.sorted()) {
        // A card that is still to be made is not forced, and had no errors before.
        if (one.code == "edit-refused") {
            diagnostics.error("edit-refused", {}, "the card would have an error; nothing is written")
                .hint("a larger --size, or fewer elements, gives each more room");
            continue;
        }
        diagnostics.add(one.severity, one.code, {}, one.message) = one;
    }
    if (!edited || edited->refused) return std::nullopt;
    return edited->text;
}

}  // namespace popup
