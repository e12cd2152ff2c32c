// Outlines that a document takes out of a drawing.
#pragma once

#include <optional>
#include <string>

#include "input/xml/path_text.h"

namespace popup::xml {

// The closed lines of a drawing, in mm, from the lower left corner of what is drawn on.
struct OutlineDrawing {
    Path path;
    Vec2 page;  // how large that is: the drawing's own size, or where it has none that of its closed lines
};
// Why there are none, as a sentence, with its place in the drawing; empty: there are some.
std::string read_outline_drawing(const std::string& name, const std::string& text, OutlineDrawing& drawing);

// Where it goes, as a picture does: its lower left corner at `at`, and turned about it.
struct OutlinePlace {
    Vec2 at;
    std::optional<double> width_mm, height_mm;  // one alone: the other follows; none: as large as it is drawn
    double rotate_deg = 0.0;
    bool mirror = false;  // right is left, in its own width
};
// The areas that it encloses there, by the even-odd rule; as read_path().
std::optional<PathRefusal> place_outline(const OutlineDrawing& drawing, const OutlinePlace& place,
                                         DrawnPath& made);

}  // namespace popup::xml
