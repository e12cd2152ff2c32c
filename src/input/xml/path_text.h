// SVG path data in documents: what it encloses, and the text of what a repair has moved.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "popup/design.h"

namespace popup::xml {

// Why path data is not taken, as a sentence without its subject: "ends where a number is missing".
struct PathRefusal {
    std::string what;
    bool too_large = false;  // of its size: there are more points than a document may have
};

// The areas that `text` encloses by the even-odd rule, in mm; subpaths that do not end with Z are closed. y
// points up, so arcs with the sweep flag run counter-clockwise. A refusal, and `path` without areas, when it
// cannot be read, leaves the page far behind or encloses nothing.
std::optional<PathRefusal> read_path(std::string_view text, Unit unit, DrawnPath& path);

// The slits of a path, each as a line in mm: where one of its lines runs out and straight back, or is
// nothing but a straight line. What encloses no area is not cut. None is shorter than 0.5 mm, and all begin
// in paper, which is within an outline and about a hole. Cost: linear, and areas times slits.
std::vector<std::vector<Vec2>> slits_of(const DrawnPath& path, bool is_hole);

// Path data of what is meant: `text` where it says just that, else its lines and curves, moved, with at most
// six decimals. Of a path without text, the rings of its areas. Precondition: `text` can be read, or is
// empty.
std::string path_text(const DrawnPath& path, Unit unit);

}  // namespace popup::xml
