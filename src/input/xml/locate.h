// Where everything of an XML text stands: tinyxml2 knows lines only, and no bytes.
//
// One pass over the text finds the start tags in document order, the attributes in each, the pieces of text
// and the ends. Elements, attributes and texts come in the very order in which tinyxml2 has them, so that the
// two can be paired one to one. What tinyxml2 lets pass although it is not XML is an error here.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "popup/diagnostics.h"

namespace popup::xml {

// Offsets are 32 bits wide, because there is one of these for every word of a large document.
using Offset = std::uint32_t;

struct LocatedAttribute {
    Offset name = 0, name_length = 0;
    Offset value = 0, value_length = 0;  // between the quotes
    Place place;                         // of the name
};

// A piece of text that is not all blank, or a CDATA section.
struct LocatedText {
    Offset begin = 0, end = 0;  // of a CDATA section: its content
    Place place;                // of the first character that is not blank
    bool cdata = false;
};

struct LocatedElement {
    Offset begin = 0;            // its "<"
    Offset tag_end = 0;          // after the ">" of its start tag
    Offset end = 0;              // after its end tag
    Offset after = 0;            // index of the first element behind it that is not inside it
    Offset first_attribute = 0;  // index into attributes; they end where those of the next element begin
    Offset first_text = 0;       // index of the first text behind its start tag
    Offset asides_before = 0;    // number of comments and instructions before it
    Place place;                 // of its "<"
};

struct Instruction {
    Offset begin = 0, end = 0;
};

// A comment that is meant for this program: its first word is "popupc:".
struct LocatedComment {
    Offset begin = 0, end = 0;  // its content, between "<!--" and "-->"
    Offset around = 0;  // index of the innermost element that it stands in, kNoElement outside the root
    Offset next = 0;    // index of the first element that begins behind it; there may be none
};
inline constexpr Offset kNoElement = static_cast<Offset>(-1);
// The word.
inline constexpr std::string_view kAddress = "popupc:";

struct Located {
    std::string_view text;
    std::vector<LocatedElement> elements;  // in document order; the first is the root
    std::vector<LocatedAttribute> attributes;
    std::vector<LocatedText> texts;
    std::vector<Instruction> instructions;  // processing instructions, the XML declaration not among them
    std::vector<LocatedComment> comments;   // those that are meant for this program, and no others
    Offset asides = 0;                      // number of comments and instructions

    [[nodiscard]] std::string_view name(Offset element) const;
};

// Tags nested deeper than this are refused, as tinyxml2 does.
inline constexpr int kDepthLimit = 100;
// Tags with more attributes than this are refused.
inline constexpr std::size_t kAttributesLimit = 1000;
// Documents with more elements, attributes, texts and comments than this are refused, to bound the memory.
inline constexpr std::size_t kMarkupLimit = 8'000'000;

// What is made of a document type declaration: an error, or nothing, for languages whose files often have
// one. Entities that it defines are not read here: a reference to one then stands for its own letters, and
// drawings expand them (input/drawing/entities.h).
enum class Doctype { refuse, skip };

// Preconditions: check_encoding() is true of `text`, which must outlive the result.
// Errors, located, each the last thing looked at: `xml-syntax`, `doctype`, `encoding` (a declaration that
// names another), `bad-character` (a reference to one that XML forbids), `document-too-large`. Cost: linear
// in bytes, but for tags with many attributes (n log n). No recursion.
std::optional<Located> locate(std::string_view text, Diagnostics& diagnostics,
                              Doctype doctype = Doctype::refuse);

// The bytes that each byte of decoded text comes from: `raw` with line ends made "\n" and, where `references`
// are read (not in CDATA), these resolved. Returns one offset into `raw` a decoded byte, and raw.size()
// behind them. Precondition: references in `raw` are well formed.
std::vector<Offset> decoded_offsets(std::string_view raw, bool references);

}  // namespace popup::xml
