#include "input/drawing/tally.h"

#include <fmt/format.h>

#include "input/drawing/variables.h"
#include "input/text.h"

namespace popup::drawing {

void Tally::count(Rows& rows, std::string_view kind, Place place) {
    auto row = rows.find(kind);
    if (row == rows.end()) row = rows.emplace(std::string(kind), Row{0, place}).first;
    ++row->second.count;
}

void Tally::tell(bool strict, Diagnostics& diagnostics) const {
    const auto is = [](int count) { return count == 1 ? " is" : "s are"; };
    for (const auto& [tag, row] : skipped_) {
        Diagnostic& told = diagnostics.warning(
            "not-cut", row.first, fmt::format("{} {} element{} not cut", row.count, tag, is(row.count)));
        if (tag == "text" || tag == "flowRoot") {
            told.hint("letters that are to be cut must be paths (in Inkscape: Path > Object to Path)");
        }
    }
    for (const auto& [tag, row] : clipped_) {
        diagnostics
            .warning("clip-ignored", row.first,
                     fmt::format("{} clip path{} not applied: what {} hides is cut, too", row.count,
                                 is(row.count), row.count == 1 ? "it" : "they"))
            .hint("cut the shapes themselves (in Inkscape: Path > Intersection)");
    }
    for (const auto& [text, row] : colors_) {
        // A variable that is set has its value here.
        const bool is_variable = has_variable(text);
        diagnostics
            .warning("color-not-read", row.first,
                     fmt::format("{} shape{} drawn in \"{}\", which is {}; that is taken for black, in which "
                                 "lines are cut",
                                 row.count, is(row.count), shown(text),
                                 is_variable ? "not set in this drawing" : "no colour that is read"))
            .hint(is_variable
                      ? "set it, as <style>:root { --fold: #0000ff }</style>, or say what lines are by "
                        "their class, id or layer, as --lines fold=NAME"
                      : "write the colour as #rrggbb or rgb(), or say what lines are by their class, "
                        "id or layer, as --lines fold=NAME");
    }
    for (const auto& [name, row] : variables_) {
        diagnostics
            .warning("style-ignored", row.first,
                     fmt::format("the variable {} is not set where {} value{} it, so {} left out",
                                 shown(name), row.count, row.count == 1 ? " needs" : "s need",
                                 row.count == 1 ? "that is" : "these are"))
            .hint(
                "set it, as <style>:root { --dashes: 3 1 }</style>, or give it a fallback: var(--dashes, 3 "
                "1)");
    }
    for (const auto& [name, row] : not_read_) {
        diagnostics
            .warning("style-ignored", row.first,
                     fmt::format(
                         "the property {} of {} element{} not read: they are drawn as if it were not there",
                         name, row.count, is(row.count)))
            .hint("write the attribute transform instead, or let the drawing program apply it to the shapes");
    }
    for (const auto& [none, row] : fills_) {
        diagnostics
            .warning(
                "fill-not-printed", row.first,
                fmt::format("{} fill{} a gradient, a pattern or a colour that is not read, and not printed",
                            row.count, is(row.count)))
            .hint("fill the shape with one colour, written as #rrggbb");
    }
    for (const auto& [tag, row] : unknown_) {
        diagnostics.add(
            strict ? Severity::error : Severity::warning, "unknown-markup", row.first,
            fmt::format("<{}> is no element of SVG that is known, and is disregarded", shown(tag)));
    }
    for (const auto& [tag, row] : hidden_) {
        diagnostics.remark("hidden-shape", row.first,
                           fmt::format("{} hidden element{} not cut", row.count, is(row.count)));
    }
}

void tell_style_sheets(const StyleSheet& sheet, std::string_view before, Place root,
                       Diagnostics& diagnostics) {
    if (sheet.imports() > 0 || before.find("<?xml-stylesheet") != std::string_view::npos) {
        diagnostics
            .warning("style-ignored", root,
                     "the drawing has a style sheet in another file, which is not read: what it says of "
                     "colours and dashes is missed")
            .hint("let the drawing program write styles into the drawing");
    }
    if (sheet.not_read() == 0) return;
    diagnostics
        .warning("style-ignored", root,
                 fmt::format("{} style {} not understood", sheet.not_read(),
                             sheet.not_read() == 1 ? "rule is" : "rules are"))
        .hint("rules for a single tag, .class or #id are read; write others as attributes");
}

}  // namespace popup::drawing
