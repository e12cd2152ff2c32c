// What stands at a byte of a document, which row tells of it, and what names a structure: its id, pages that
// are called by it, and the folds and plates that others stand on.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lsp/features.h"
#include "lsp/markup.h"
#include "popup/mechanism.h"

namespace popup::lsp {

// A document with its tags.
struct MarkedText {
    std::string_view text;
    Markup markup;

    [[nodiscard]] std::string_view word(Span at) const { return text.substr(at.begin, at.size()); }
    [[nodiscard]] const MarkupElement& element(int number) const {
        return markup.elements[static_cast<std::size_t>(number)];
    }
    [[nodiscard]] std::span<const MarkupAttribute> attributes(int element) const;
    // The attribute that means that; null: there is none.
    [[nodiscard]] const MarkupAttribute* attribute(int element, xml::Name name) const;
    // The structure that an element is or is in; -1: none.
    [[nodiscard]] int structure_of(int element) const;
    // Where the value of a field is, be it an attribute or a child element of an element.
    [[nodiscard]] std::optional<Span> value(int element, xml::Name name) const;
    // The row of a structure's type; null: it has none, or nobody knows it.
    [[nodiscard]] const ElementInfo* row(int structure) const;
    // All structures, in document order.
    [[nodiscard]] std::vector<int> structures() const;
};
MarkedText marked(std::string_view text);

// The parameter of a row, or of any row where `info` is null or has none of that name.
const ParameterInfo* parameter_of(const ElementInfo* info, std::string_view spelling);
// Whether values of that name are colours.
bool is_color(xml::Name name, std::string_view spelling, const ElementInfo* info);
// "0 to 90, in degrees": what a parameter takes.
std::string takes(const ParameterInfo& parameter);
// A row as a popup: what it is, its points, folds and parameters.
std::string row_markdown(const ElementInfo& info);
// "B, on the left, on the page of the fold that it stands on; its partner is E".
std::string point_markdown(const ElementInfo& info, std::size_t number);

// The id of each of MarkedText::structures(), in their order: as given, or as the reader makes it.
std::vector<std::string> ids_of(const MarkedText& text);

// A value that names a structure: page="roof", on="roof.centre".
struct Naming {
    int element = -1;                     // that has the value, or is it
    xml::Name what = xml::Name::unknown;  // page or on
    Span value;                           // without blanks around it
    Span id;                              // in it
};
// In document order. What has a name of the page itself, or a number, names none. Cost: linear.
std::vector<Naming> namings(const MarkedText& text);

// A fold or plate by its name.
struct NamedPlace {
    std::string name;   // "bird.centre"
    std::string about;  // "the centre fold of "bird""
};
// All that a structure can stand on: what is before it in the text, the page's first. `plates`: in place of
// folds.
std::vector<NamedPlace> places_before(const MarkedText& text, int structure, bool plates);

// The version that the document says it has; "2.0" where it says none.
std::string_view version_of(const MarkedText& text);

}  // namespace popup::lsp
