// The Design: what the author asked for, with the place of every word of it.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "popup/assembly.h"
#include "popup/diagnostics.h"
#include "popup/files.h"
#include "popup/geometry.h"
#include "popup/path.h"
#include "popup/print.h"

namespace popup {

// Where a value stands in the source text, in bytes; length 0 and offset npos when it was not written.
// input/ makes these: with them repairs and edits change the author's numbers and nothing else of the file.
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
    TextRange x_text, y_text, page_text;  // where the numbers stand
    TextRange tag_text;    // the start tag, where a missing page attribute would go; absent in a list as text
    bool changed = false;  // true once a repair has moved it: `at` (or page) differs from what is written
};

// A fold or plate that is given by its name and not by points: "bird.centre". What stands there gives its
// points beside it: x across the fold, to the right, and y along it, from its middle; so it follows the fold
// wherever that goes. Of the gutter that is where the page has them anyway.
struct NamedGround {
    std::string text;                  // as the canonical document has it; empty: nothing is named
    std::optional<std::size_t> owner;  // the structure that makes it, by number; none: the page
    std::size_t which = 0;             // among the folds or plates of its row, or of the page
    TextRange range;                   // as written
    bool changed = false;              // `text` differs from what is written
    [[nodiscard]] bool given() const { return !text.empty(); }
};

struct ParentFold {
    NamedGround on;  // then page, begin and end have no meaning
    int page = 0;
    DesignPoint begin, end;
    Place place;
    TextRange page_text, tag_text;  // the page as written; the start tag, where a missing one would go
    bool page_changed = false;
};

// A plate, named by any point of it, or by its name.
struct ParentPlate {
    NamedGround on;  // then page and point have no meaning
    int page = 0;
    DesignPoint at;
    Place place;
    TextRange page_text, tag_text;  // as of ParentFold
    bool page_changed = false;
};

// What path data encloses.
struct DrawnPath {
    std::string text;    // as written: SVG path data in the document's unit, y up
    bool moved = false;  // `path` is not what `text` says
    Path path;           // as meant, in mm
    Enclosed inside;     // of `path`
};

// The value of one parameter of an element's row (popup/mechanism.h), outer points aside.
struct Argument {
    // Nothing where the author gave none; a length in mm, a plain number; a word of the row's list.
    std::variant<std::monostate, Color, double, std::string, DrawnPath, std::vector<DesignPoint>> value;
    std::optional<int> page;    // of a path or of points, where the author gave one
    Place place;                // of what was written
    TextRange text, page_text;  // the value and the page as written
    TextRange tag_text;         // the start tag, where a missing page would go
    bool changed = false;       // true once a repair has changed it: it differs from what is written
    [[nodiscard]] bool given() const { return value.index() != 0; }
};

struct Structure {
    std::string type;  // canonical name of an element row
    std::string id;    // never empty: given, or e<n>
    bool id_given = false;
    Place place;  // of its start tag
    Place type_place;
    TextRange type_text;  // the value of the type, code or name
    TextRange tag_text;   // the whole element, from "<" to after its end tag: for --drop
    TextRange start_tag;  // where a value would go that was not written
    TextRange id_text;    // the id as written
    bool type_changed = false;
    bool id_changed = false;
    bool dropped = false;             // taken out by `fix --drop`
    bool added = false;               // by an edit: nothing of it stands in the text
    std::vector<DesignPoint> points;  // in the order of the element's row
    // The other values, in the order of the row's parameters; those past the end were not given.
    std::vector<Argument> arguments;
    ParentFold fold;                   // what it stands on, fold or seam, unless it stands on a plate
    std::optional<ParentPlate> plate;  // then `fold` has no meaning
    // Neither was named: of `fold` only the page has a meaning, and check() finds what it stands on there.
    bool finds_ground = false;

    // The page of what it stands on; of what is named, without meaning.
    [[nodiscard]] int ground_page() const { return plate ? plate->page : fold.page; }
    // The name of what it stands on, where that is given.
    [[nodiscard]] const NamedGround& named() const { return plate ? plate->on : fold.on; }
    [[nodiscard]] NamedGround& named() { return plate ? plate->on : fold.on; }
    // The n-th argument, which is made if need be.
    Argument& argument(std::size_t n) {
        if (arguments.size() <= n) arguments.resize(n + 1);
        return arguments[n];
    }
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

// How a picture fills the rectangle that it is given.
enum class PictureFit {
    stretch,  // its corners are those of the rectangle
    contain,  // whole, in the middle, its sides as they are to each other
    cover     // the same, as large as leaves nothing bare; what sticks out is cut off
};
inline constexpr std::array<std::string_view, 3> kPictureFitNames{"stretch", "contain", "cover"};

// A picture from a file, in a rectangle.
struct DrawnImage {
    std::string href;  // as written, of a file below the folder of the document
    Place href_place;
    double width_mm = 0.0, height_mm = 0.0;  // > 0
    PictureFit fit = PictureFit::stretch;
    std::optional<double> horizon;     // 0 the lower edge of the picture, 1 the upper one
    std::optional<double> horizon_mm;  // above the open card
    Image picture;                     // the file, opened
};

struct DrawnText {
    std::string text;        // UTF-8, one line, not empty
    double height_mm = 0.0;  // of the capitals, > 0
    TextFont font = TextFont::sans;
    Color fill{0, 0, 0};
};

struct DrawnArea {
    DrawnPath shape;
    TextRange d_text;  // the path data as written
    Color fill{0, 0, 0};
};

// What is printed beside drawn lines.
struct DrawnPrint {
    int page = 0;
    std::variant<DrawnImage, DrawnText, DrawnArea> what;
    // Of a picture its lower left corner, about which it is turned; of a text its middle; of an area nothing.
    DesignPoint at;
    double rotate_deg = 0.0;  // counter-clockwise
    TextRange rotate_text;
    Place place;
    TextRange page_text, tag_text;  // as of lines
    bool page_changed = false;
    bool dropped = false;  // likewise
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
    Orientation orientation = Orientation::guessed;
    double opens_deg = 180.0;  // how far the card opens: above 0, at most 180
    std::optional<Color> left, right;
    Place page_place;
    TextRange list_text;     // the list of structures, from "<" to after its end tag
    TextRange version_text;  // the version as written
    TextRange root_tag;      // the start tag of the document
    TextRange root_text;     // the whole document, from "<" to after its end tag
    bool version_changed = false;
    std::vector<Structure> structures;  // build order, parents first
    std::vector<DrawnLine> lines;
    std::vector<DrawnPrint> prints;  // painted before the lines, texts after them, as popup/print.h has it
};

}  // namespace popup
