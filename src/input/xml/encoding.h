// The bytes of a document, before anything is made of them.
#pragma once

#include <string_view>

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

// Adds an error and returns false when the text is empty (`empty-input`), not UTF-8 (`encoding`), or holds a
// character that XML forbids (`bad-character`). Only the first such place is reported.
bool check_encoding(std::string_view text, Diagnostics& diagnostics);

}  // namespace popup::xml
