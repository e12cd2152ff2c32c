// What the panels of a carton are called: guessed by their shape, their size and their place.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "folded/lower.h"
#include "folded/sheet.h"

namespace popup::folded {

// By panel: its name within its piece, unlike the others of the piece; empty for those of pieces that are no
// carton. A carton is a piece without loops whose panels are
//
// * a tube: at least three walls side by side, between parallel folds as long as the walls, which all go the
//   same way. A ring is preferred, whose walls are as high as one another and opposite ones as wide (or, with
//   a glue flap, as wide as the sides of a panel on its end are long), and of rings one that has a glue flap.
//   The wall beside the glue flap is `front`, else the largest; opposite it is `back`, beside these are
//   `right` and `left` (`wall-2` and so on where there are not four). A last wall that is narrower than half
//   of the narrowest (where walls are odd in number, than nine tenths of it), and has nothing hanging on it,
//   is the `glue-flap`. A wall that a crease parts, which lies flat in the end, as the sides of bags are, is
//   two panels, `left-1` and `left-2`. What closes an end is the `top` or the `bottom`, the narrow panel at
//   its far edge its `top-tuck`, what hangs at the end of the other walls `top-dust-flap-left`; where nothing
//   closes an end alone there are `top-flap-front` and the like, and what is beyond an oblique crease of
//   theirs that is drawn to lie flat in the end is a `top-glue-corner-left`. The top lies on the left of the
//   walls, as they are numbered: upwards in most drawings;
// * a tray: a `base` with walls on three or four of its sides, `front` at the bottom of the drawing, `back`,
//   `left` and `right`; of a deep tray the bottom, and not a wall with its corners. What hangs at a wall's
//   end is a `front-corner-left`, what hangs at the top of a wall a `front-lining` (of a wall that is rolled
//   in the narrow strip at its top is its `front-rim`), or the
//   `lid` where it is as large as the base, with its `lid-tuck`, its `lid-ear-left` and its
//   `lid-tuck-ear-left`. Bottom, back, lid and tuck look like the walls of a tube with a glue flap: where the
//   sides are rolled in, or no lid of the tube has a tuck and its glue flap is half as wide as its narrowest
//   wall, they are taken for a tray.
//
// Names go by how folds are drawn, not by how far they are folded in the end.
// A panel of less than a tenth of the one that it hangs on is its lock (`back-lock`); any other is `panel-7`,
// by its place in the tree. Cost: near linear in panels and folds.
std::vector<std::string> name_panels(const CreasePattern& pattern, const Sheet& sheet, const Tree& tree);

// Whether a panel that is called so ("sheet/left", "sheet-2/left-1") stands around a box or is its base: a
// wall, the base, or a glue flap that closes a row of walls.
bool is_of_walls(std::string_view name);

}  // namespace popup::folded
