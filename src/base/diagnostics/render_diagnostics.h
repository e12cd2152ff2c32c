// Diagnostics as text for people and as JSON for programs. Makes strings; printing is the program's business.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "popup/diagnostics.h"

namespace popup {

// Makes what a terminal would act on visible instead: control characters and bidirectional overrides become
// "\x1b" or "\u202e", bytes that are no UTF-8 "\xff", tabs and line breaks one space. Everything else is
// kept. What comes out may stand in XML.
std::string visible(std::string_view text);

// Finds places in one text. Asking in ascending order costs one pass over the text altogether, however many
// questions. Asking again, in any order, about what has been passed costs a look at 64 KiB at most.
class PlaceFinder {
 public:
    // `text` must outlive this object.
    explicit PlaceFinder(std::string_view text) : text_(text) {}
    // Byte offsets of the start of the place's line and of its character; a column behind the end of the line
    // gives the end. False when the text has no such line.
    bool find(Place place, std::size_t& line_start, std::size_t& caret);
    [[nodiscard]] std::string_view text() const { return text_; }

 private:
    // A character, with its line.
    struct Mark {
        std::size_t line_start = 0, caret = 0;
        int line = 1, column = 1;
    };
    std::string_view text_;
    Mark at_;
    std::vector<Mark> marks_;  // passed on the way, ascending
};

// "FILE:LINE:COLUMN: SEVERITY: MESSAGE [CODE]" and a line break. A diagnostic without a file speaks of the
// run and begins with "popupc:".
std::string render_short(const Diagnostic& diagnostic, bool color = false);

// render_short(), then the source line with a caret under the column, then what a repair changed, then each
// related place ("  with: FILE:LINE:COLUMN: TEXT") with its own source line, then one line a hint. Tabs take
// four columns, wide characters two; a long line is cut to a window around the caret.
std::string render_text(const Diagnostic& diagnostic, PlaceFinder& source, bool color = false);

// Of these, the source line with a caret under the column; empty for a place without a column.
std::string render_excerpt(Place place, PlaceFinder& source);

// One object: file, line, column, severity, code, element, message, hints, before, after; null for what there
// is not. Where there are related places, also `related`: a list of {line, column, text}.
nlohmann::ordered_json to_json(const Diagnostic& diagnostic);

// to_json() on one line, with a line break. Invalid UTF-8 is replaced.
std::string render_json(const Diagnostic& diagnostic);

}  // namespace popup
