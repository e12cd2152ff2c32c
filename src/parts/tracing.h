// A drawing as flat lines in millimetres, before it is known which of them make a part.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "popup/curves.h"
#include "popup/diagnostics.h"
#include "popup/geometry.h"
#include "popup/print.h"

namespace popup::drawing {

// What a line was drawn for.
enum class Use {
    cut,
    mountain,
    valley,
    seam,
    shape,  // the outline of a fill without a stroke: a cut only where a drawing has no others
    print,
};

// What names say of a line: those of its layer, classes and id, or a rule that the caller gave.
enum class Named { nothing, cut, fold, mountain, valley, hole, print, ignore };

// How a stroke is broken.
enum class Dash {
    none,
    even,   // dashes of one length
    mixed,  // dots among dashes
};

// An element that drew something.
struct TracedElement {
    std::string name;   // its id or label; may be empty
    std::string group;  // the id of the group it stands in; may be empty
    Place place;
};

struct TracedLine {
    std::vector<Vec2> points;  // at least two, on the grid, no point twice in a row
    bool closed = false;
    Use use = Use::cut;
    int element = 0;  // index into Tracing::elements
    int owner = 0;    // index into Tracing::owners
    Color color;      // of the stroke
    double width_mm = 0.0;
    Dash dash = Dash::none;
    Named named = Named::nothing;
    bool ruled = false;                  // `named` is the caller's
    bool of_machine = false;             // of a sheet that this program made for a machine
    std::optional<double> opacity = {};  // of the stroke; none: the format has no such thing
    double dash_mm = 0.0, gap_mm = 0.0;  // the longest of its stroke; 0: not known
    // How far it is folded, as the drawing says, [-180, 180]; less than 0: the other way than it is drawn.
    std::optional<double> fold_deg = {};
    bool perforated = false;  // it is a fold because its name says perforation
};

// An area that is painted, by all subpaths of a path together.
struct TracedFill {
    std::vector<Ring> rings;
    bool even_odd = false;
    bool without_stroke = false;
    bool is_printed = true;  // not so of gradients and patterns
    Color color;
    int element = 0;
    int owner = 0;
};

struct TracedText {
    Text text;
    int owner = 0;
};

// Whose a line is: 0 when only its place can tell, else a piece of a sheet that this program made.
struct TracedOwner {
    std::string name;
    Place place;
};

struct Tracing {
    std::vector<TracedElement> elements;
    std::vector<TracedOwner> owners{{}};
    std::vector<TracedLine> lines;
    std::vector<TracedFill> fills;
    std::vector<TracedText> texts;
    CurveTable curves;  // of all lines and fills
    int invisible = 0;  // shapes with neither stroke nor fill
    Vec2 page;          // size of the drawing, mm; 0 when it is not said
    Ruler ruler;
    // Lines are what their layers are called even of flat parts: in CAD drawings these are chosen to say it.
    bool by_layers = false;
    bool own_sheet = false;  // this program made the drawing
};

}  // namespace popup::drawing
