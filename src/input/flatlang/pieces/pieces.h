// From what a turtle drew to parts that can be cut.
#pragma once

#include <optional>

#include "input/flatlang/turtle/trail.h"
#include "parts/flat_parts.h"
#include "popup/diagnostics.h"

namespace popup::flatlang {

// The parts of a trail, in mm, in the order in which they were begun, and its model.
//
// Besides the trail's polygons, lines of a part whose ends meet in one plane are a loop, in whatever strokes
// they were drawn (strokes.h).
//
// Loops of a part that lie in one plane make its paper by containment: a loop in a loop is a hole, one in a
// hole is paper again. Loops drawn twice count once. Those without an area (lines there and back) are lines.
// Which side of a plane is the front is said in outlines.h: what is drawn on the ground is seen from above.
//
// What was drawn before the first part makes a part of each outermost loop, with what lies in it. Of a part
// with a name, all that lies flat in one plane is one part, in its drawn arrangement.
//
// Loops of a part that share a stretch of an edge in space, in two planes, are joined there by a fold with
// its angle: they unfold into one piece, with creases. A valley is a fold that brings the fronts together;
// the front is that of the loop that was closed first. Within a part with a name, loops that share an edge in
// one plane are joined too, by a valley that is not folded (it has no angle: the program drew the line, so it
// is scored); without a name, they are pieces of their own, cut apart along the line. An edge that three
// share is cut, and so is one whose fold would make the piece overlap itself; a face that finds no place
// begins a piece of its own. Pieces that do not hang together are parts of the same name, numbered.
//
// Parts of one name are numbered ("gear 2"); those without a name are called "piece". Control characters of
// names are spaces.
//
// The model has a node for each part, with its faces where they were drawn, its outlines, and lines that were
// drawn with it; a node "trail" has lines drawn before the first part, and lines of parts without a face are
// nodes of their names.
//
// Errors: `flatlang-no-parts`, when there is no loop with an area; those of find_outlines(), located at the
// part's beginning. Remark: `flatlang-open-lines`, of what is no part of a loop and not cut; a warning of
// each part that has lines and no loop. Cost: near linear; what is far from it ends as `document-too-large`.
std::optional<FlatParts> make_parts(const Trail& trail, Diagnostics& diagnostics);

}  // namespace popup::flatlang
