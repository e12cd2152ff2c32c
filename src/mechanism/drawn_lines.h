// Drawn lines that cross: a piece of paper stays one piece, and a hole is cut once.
//
//     if (!mend_outline(e)) return false;           // what a glued piece is drawn as
//     if (!mend_holes(e, "hole", "its hole")) …     // what is cut out, each line a hole
#pragma once

#include <span>
#include <string_view>

#include "mechanism/border.h"
#include "mechanism/element.h"

namespace popup {

// Puts a path into the parameter in place of what is there, as a change; nothing where it encloses too much
// to tell.
void write_path(Element& e, std::string_view name, Path path);

// What was left out of a line of so many edges, as a repair: `what` is the line ("its outline"), and `left`
// what it encloses now, in mm². Loops no larger than rounding go without a word. True when it was told.
bool tell_loops(Element& e, std::string_view what, std::span<const DroppedLoop> dropped, std::size_t edges,
                double left);

// The parameter `outline` of a glued piece, which the even-odd rule may divide into parts that hang on
// points: of each line that crosses itself the loop of larger area is kept, and holes that overlap become one
// (`outline-crosses`, `holes-cross`). What encloses one area that touches itself nowhere stays as it is.
// False after failed(): it crosses itself too often to tell.
bool mend_outline(Element& e);
// The same of a parameter whose lines are holes; they are called `what`. A hole in a hole stays an island,
// for the row to refuse.
bool mend_holes(Element& e, std::string_view name, std::string_view what);

}  // namespace popup
