// A JSON document as a tree in which every value knows where it stands.
//
//     const std::optional<JsonValue> tree = read_json(source.text, "oa-syntax", diagnostics);
//     if (const JsonList* list = tree->list()) ...
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "popup/diagnostics.h"

namespace popup {

struct JsonValue;
struct JsonMember;
using JsonList = std::vector<JsonValue>;
using JsonObject = std::vector<JsonMember>;  // in the order of the text; names differ

struct JsonValue {
    std::variant<std::monostate, bool, double, std::string, JsonList, JsonObject> value;
    std::size_t at = 0;  // the byte where it begins

    [[nodiscard]] bool null() const { return value.index() == 0; }
    [[nodiscard]] const bool* flag() const { return std::get_if<bool>(&value); }
    [[nodiscard]] const double* number() const { return std::get_if<double>(&value); }
    [[nodiscard]] const std::string* text() const { return std::get_if<std::string>(&value); }
    [[nodiscard]] const JsonList* list() const { return std::get_if<JsonList>(&value); }
    [[nodiscard]] const JsonObject* object() const { return std::get_if<JsonObject>(&value); }
    // The member of that name; null: there is none, or it is no object.
    [[nodiscard]] const JsonValue* member(std::string_view name) const;
};

struct JsonMember {
    std::string name;
    JsonValue value;
};

// Values deeper than this, objects with more members and documents with more values are refused.
inline constexpr std::size_t kDepthLimit = 32;
inline constexpr std::size_t kMembersLimit = 64;
inline constexpr std::size_t kValuesLimit = 8'000'000;

// Errors: `empty-input` where the text is empty or blank; `syntax_code` where it is no JSON, an object has
// two members of one name or the limits of depth and members are exceeded; `document-too-large`. Numbers are
// finite, texts are UTF-8. Cost: linear.
std::optional<JsonValue> read_json(std::string_view text, std::string_view syntax_code,
                                   Diagnostics& diagnostics);

}  // namespace popup
