// The fields of an element, however they are spelt: as attributes, child elements, or text.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "input/xml/names.h"
#include "input/xml/tree.h"
#include "popup/design.h"
#include "popup/diagnostics.h"
#include "popup/mechanism.h"

namespace popup::xml {

// Collects the findings of one reading, and remembers which structure each is about: names that structures
// without an id get are known only at the end.
class Reporter {
 public:
    Reporter(Diagnostics& diagnostics, bool strict) : diagnostics_(diagnostics), strict_(strict) {}

    Diagnostic& error(std::string_view code, Place place, std::string message);
    Diagnostic& warning(std::string_view code, Place place, std::string message);
    // An attribute or element that `context` does not know: a warning, under --strict an error.
    void unknown_name(Name context, std::string_view name, Place place, bool attribute);
    // A value that structures of other types have, likewise; the hint says which this one has.
    void value_of_others(const ElementInfo& info, std::string_view name, Place place, bool attribute);
    void unknown_text(Name context, const Text& text);
    // A field that is given a second time.
    void twice(std::string_view name, Place place, Place first);
    // The same of the texts of one element, between which something stands. Precondition: two at least.
    void in_parts(std::string_view name, const std::vector<Text>& texts);

    // Findings up to the next call are about the n-th structure; kNone: about none.
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    void set_structure(std::size_t n) { structure_ = n; }
    void name_structures(const std::vector<Structure>& structures);
    [[nodiscard]] Diagnostics& diagnostics() { return diagnostics_; }

 private:
    Diagnostic& add(Severity severity, std::string_view code, Place place, std::string message);
    Diagnostics& diagnostics_;
    bool strict_;
    std::size_t unknown_ = 0;
    std::size_t structure_ = kNone;
    std::vector<std::pair<Diagnostic*, std::size_t>> about_;
};

struct Field {
    Name name = Name::unknown;
    Place place;
    Text text;                        // of an attribute
    Node node;                        // of a child element; null for an attribute
    std::string_view parameter = {};  // of an argument: the name of its parameter
    [[nodiscard]] std::string_view word() const { return parameter.empty() ? canonical(name) : parameter; }
};

// Gathers what stands in one element. Unknown markup, text where none belongs and fields given twice are
// reported.
class Fields {
 public:
    // Takes in all attributes, child elements and texts of `node`.
    Fields(Node node, Name context, Reporter& reporter);

    // For children that are not in the node's tree. The name of one that is wanted; `unknown`, and a finding,
    // when it is not known or there already.
    Name wants(std::string_view spelling, Place place);
    void add(Name name, Node child);

    // The field, or null.
    [[nodiscard]] const Field* find(Name name) const;
    // The same of a parameter, by its canonical name.
    [[nodiscard]] const Field* find(std::string_view parameter) const;
    [[nodiscard]] std::span<const Field> all() const { return fields_; }
    // Child elements that may stand several times.
    [[nodiscard]] std::span<const Node> repeated() const { return repeated_; }
    // Text of the element itself.
    [[nodiscard]] std::span<const Text> texts() const { return texts_; }
    // Reports its text as unknown: the value stands elsewhere.
    void refuse_text();
    [[nodiscard]] Name context() const { return context_; }
    [[nodiscard]] Node node() const { return node_; }

 private:
    // As find_name(), and the parameter where the name is one.
    [[nodiscard]] Name name_of(std::string_view spelling, std::string_view& parameter) const;
    [[nodiscard]] const Field* find(Name name, std::string_view parameter) const;
    Node node_;
    Name context_;
    Reporter& reporter_;
    std::vector<Field> fields_;
    std::vector<Node> repeated_;
    std::vector<Text> texts_;
};

// The one value of a field that is a single value. An error and nullopt when it is empty or given twice over.
std::optional<Text> value_of(const Field& field, Reporter& reporter);

}  // namespace popup::xml
