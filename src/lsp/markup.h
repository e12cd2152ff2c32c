// The tags of a document that is being typed: whatever stands there, there is a tree.
//
// The reader of documents refuses a text that is not well formed. An editor asks about such texts most of the
// time, so this one takes them: a tag without its ">" ends before the next "<", an element without its end
// tag where the next one begins that cannot stand in it, and an end tag of nothing is passed over. What each
// word means follows from the reader's own table (input/xml/names.h).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "input/xml/names.h"
#include "lsp/text.h"

namespace popup::lsp {

struct MarkupAttribute {
    Span name;
    Span value;           // between the quotes; empty and behind the name where there is none
    bool quoted = false;  // has both its quotes
};

struct MarkupElement {
    std::size_t begin = 0;  // its "<"
    std::size_t end = 0;    // behind its end tag, or where it ends for want of one
    Span name;
    Span tag;                          // the start tag, from "<" to behind ">" or where it breaks off
    Span end_name;                     // of its end tag; empty: it has none
    bool closed_tag = false;           // the start tag has its ">"
    bool empty = false;                // <a/>
    int parent = -1;                   // number of an element before it
    std::size_t after = 0;             // number of the first element behind it that is not in it
    std::size_t first = 0, count = 0;  // attributes
    // What it is: `unknown` where its parent has nothing of that name, `argument` where it is a parameter of
    // some element's row.
    xml::Name what = xml::Name::unknown;

    [[nodiscard]] Span all() const { return {begin, end}; }
};

struct MarkupComment {
    Span at;  // from "<!--" to behind "-->"
};

struct Markup {
    std::vector<MarkupElement> elements;  // in document order
    std::vector<MarkupAttribute> attributes;
    std::vector<MarkupComment> comments;

    // The innermost element that a byte is in, its tags included; a byte at its very end is in it where it
    // ends for want of an end tag. -1: none.
    [[nodiscard]] int at(std::size_t offset) const;
    // The children of an element, or of the document (-1).
    [[nodiscard]] std::vector<int> children(int element) const;
};

// Any bytes may come. Cost: linear, but for the depth where end tags are missing, which is at most 100. No
// recursion.
Markup read_markup(std::string_view text);

// What `spelling` is as an attribute or a child of an element that is `context`.
xml::Name meaning(xml::Name context, std::string_view spelling);

}  // namespace popup::lsp
