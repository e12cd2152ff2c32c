// The bytes of a document, before anything is made of them.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

#include "popup/diagnostics.h"

namespace popup::xml {

inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

// The place of a byte. Asking in ascending order costs one pass over the text altogether; columns count code
// points and a byte order mark is not counted.
class PlaceCounter {
 public:
    // `text` must outlive this object.
    explicit PlaceCounter(std::string_view text)
        : text_(text), at_(text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0) {}
    // Precondition: `offset` is not before the one asked last.
    Place at(std::size_t offset);
    [[nodiscard]] std::size_t size() const { return text_.size(); }

 private:
    std::string_view text_;
    std::size_t at_;
    Place place_{1, 1};
};

// The same places for questions in any order, both ways. Cost: one pass over the text to begin with, then
// that of a line each.
class PlaceTable {
 public:
    // `text` must outlive this object.
    explicit PlaceTable(std::string_view text);
    // nullopt: it is behind the text.
    [[nodiscard]] std::optional<Place> place_of(std::size_t offset) const;
    // nullopt: there is no such line. A column behind the end of its line is that end.
    [[nodiscard]] std::optional<std::size_t> offset_of(Place place) const;

 private:
    std::string_view text_;
    std::vector<std::size_t> lines_;  // where each begins
};

// Adds an error and returns false when the text is empty (`empty-input`), not UTF-8 (`encoding`), or holds a
// character that XML forbids (`bad-character`). Only the first such place is reported.
bool check_encoding(std::string_view text, Diagnostics& diagnostics);

}  // namespace popup::xml
