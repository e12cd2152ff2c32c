// A document as its editor has it: bytes, and the positions that the protocol names them by.
//
//     Text text("<popup>\r\n</popup>\r\n");
//     const std::size_t at = text.offset({1, 2}, Encoding::utf16);  // the byte of "popup" in the second line
//     text.replace({at, at + 5}, "card");
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "popup/diagnostics.h"

namespace popup::lsp {

// What a position counts within its line. The protocol's own is UTF-16: of characters beyond U+FFFF each
// counts two.
enum class Encoding { utf16, utf8, utf32 };
std::string_view to_string(Encoding encoding);
// The encoding of that name ("utf-8"); nullopt: there is none.
std::optional<Encoding> find_encoding(std::string_view name);

// Both count from 0, as the protocol does.
struct Position {
    int line = 0;
    int character = 0;
    friend bool operator==(const Position&, const Position&) = default;
};

// Bytes [begin, end) of a text.
struct Span {
    std::size_t begin = 0;
    std::size_t end = 0;
    [[nodiscard]] std::size_t size() const { return end - begin; }
    [[nodiscard]] bool contains(std::size_t at) const { return begin <= at && at < end; }
    // The same with its end: where a cursor stands that has just typed the last character.
    [[nodiscard]] bool touches(std::size_t at) const { return begin <= at && at <= end; }
    friend bool operator==(const Span&, const Span&) = default;
};

struct TextEdit {
    Span at;
    std::string text;
    friend bool operator==(const TextEdit&, const TextEdit&) = default;
};

// A text, UTF-8, with its lines. Lines end with "\n", "\r\n" or "\r", as the protocol has it.
class Text {
 public:
    explicit Text(std::string bytes = {});

    [[nodiscard]] const std::string& bytes() const { return bytes_; }
    [[nodiscard]] std::size_t size() const { return bytes_.size(); }
    // The number of its last line.
    [[nodiscard]] int last_line() const { return static_cast<int>(starts_.size()) - 1; }

    // The byte at a position. Any position may come: behind the end of a line it is that end, behind the last
    // line the end of the text, within a character (a half of a surrogate pair) its beginning. Cost: as
    // position()'s.
    [[nodiscard]] std::size_t offset(Position position, Encoding encoding) const;
    // The position of a byte; of one within a character that of the character. Cost: log n, and a thousand
    // bytes of the line, however long it is. Precondition: at ≤ size().
    [[nodiscard]] Position position(std::size_t at, Encoding encoding) const;

    // The byte of a finding's place, whose lines end with "\n" alone, and whose columns count characters; a
    // byte order mark is none. Any place may come; {0, 0} is the beginning.
    [[nodiscard]] std::size_t offset(Place place) const;

    // Precondition: at.begin ≤ at.end ≤ size(). Cost: linear in the text, in bytes that are copied.
    void replace(Span at, std::string_view text);

 private:
    // A place between characters, and what all before it count.
    struct Counted {
        std::size_t at = 0;
        std::size_t utf16 = 0;
        std::size_t utf32 = 0;
        [[nodiscard]] std::size_t units(Encoding encoding) const;
    };
    void find_lines();
    void count_units();
    [[nodiscard]] std::size_t end_of_line(std::size_t line) const;
    // Up to the last place between characters that is not behind `at`.
    [[nodiscard]] Counted counted(std::size_t at) const;
    // The byte `units` behind `from`, or `limit`, whichever comes first.
    [[nodiscard]] std::size_t ahead(std::size_t from, std::size_t units, Encoding encoding,
                                    std::size_t limit) const;
    std::string bytes_;
    std::vector<std::size_t> starts_;  // of the protocol's lines; the first is 0
    std::vector<std::size_t> feeds_;   // of lines that end with "\n" alone
    std::vector<Counted> counts_;      // a thousand bytes apart, the first at 0
};

// The text with the edits made. Precondition: they lie within it and do not overlap; any order.
std::string with_edits(std::string_view text, std::vector<TextEdit> edits);

// The one stretch in which two texts differ, as the edit that makes the second of the first; cut at
// characters, never within, nor within a line's end "\r\n", where the protocol has no position. Equal texts:
// an empty edit at their end.
TextEdit difference(std::string_view before, std::string_view after);

// The differences of two texts line by line: edits that make the second of the first, each as short as the
// lines allow. Cost: near linear; where the texts have little in common it is one edit.
std::vector<TextEdit> differences(std::string_view before, std::string_view after);

}  // namespace popup::lsp
