// A drawing of a folded sheet whose lines have moved, written anew.
#pragma once

#include <optional>
#include <string>

#include "popup/sheet_edit.h"

namespace popup::edit {

// The SVG drawing with the lines of `pattern`, which was read from it, where `edited` has them. Elements that
// do not move stay byte for byte, but for data-fold-angle, which says the angles of folds that `edited`
// gives. The remark `folds-turn` at elements that cannot have it. nullopt after `edit-refused`, at the place
// of an element that cannot be written: what use elements or nested pictures draw, circles that are such no
// more. Rectangles become polygons. Cost: linear in the drawing, n log n in what moves.
std::optional<std::string> write_moved(const Source& source, const CreasePattern& pattern,
                                       const EditedSheet& edited, Diagnostics& diagnostics);

}  // namespace popup::edit
