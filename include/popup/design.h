// The Design: what the author asked for, with the place of every word of it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "popup/diagnostics.h"
#include "popup/files.h"
#include "popup/geometry.h"
#include "popup/print.h"

namespace popup {

// Where a value stands in the source text, in bytes; length 0 and offset npos when it was not written.
// Only input/ makes and uses these: with them a repair changes the author's numbers and nothing else of the
// file.
struct TextRange {
    std::size_t offset = std::string::npos;
    std::size_t length = 0;
    [[nodiscard]] bool present() const { return offset != std::string::npos; }
};

// A point as written. `at` is in millimetres on its page.
struct DesignPoint {
    Vec2 at;
    std::optional<int> page;  // only where the author gave one
    Place place;
    TextRange x_text, y_text, page_text;
    TextRange tag_text;    // the start tag, where a missing page attribute would go; absent in a list as text
    bool changed = false;  // true once a repair has moved it: `at` (or page) differs from what is written
};

struct ParentFold {
    int page = 0;
    DesignPoint begin, end;
    Place place;
    TextRange page_text, tag_text;  // the page as written; the start tag, where a missing one would go
    bool page_changed = false;
};

struct Structure {
    std::string type;  // canonical name of an element row
    std::string id;    // never empty: given, or e<n>
    bool id_given = false;
    Place place;  // of its start tag
    Place type_place;
    TextRange type_text;  // the value of the type, code or name
    TextRange tag_text;   // the whole element, from "<" to after its end tag: for --drop
    bool type_changed = false;
    bool dropped = false;             // taken out by `fix --drop`
    std::vector<DesignPoint> points;  // in the order of the element's row
    ParentFold fold;
    std::optional<Color> left, right, left_tab, right_tab;
};

struct DrawnLine {
    int page = 0;
    double thickness_pt = 1.0;
    Color color{0, 0, 0};
    std::vector<DesignPoint> points;
    Place place;
    TextRange page_text;  // the page as written
    TextRange tag_text;   // the whole element, as of a structure
    bool page_changed = false;
    bool dropped = false;  // its page went with a dropped structure
};

// Length unit of the document. Numbers in the file times `mm` are millimetres.
struct Unit {
    std::string_view name = "in";
    double mm = 25.4;
};

struct Design {
    std::string file;  // as named on the command line
    std::string stem;
    std::string version = "2.0";
    Unit unit;
    double width_mm = 279.4;   // > 0
    double height_mm = 215.9;  // > 0
    std::optional<Color> left, right;
    Place page_place;
    std::vector<Structure> structures;  // build order, parents first
    std::vector<DrawnLine> lines;
};

}  // namespace popup
