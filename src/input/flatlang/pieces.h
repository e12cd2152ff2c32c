// From what a turtle drew to parts that can be cut.
#pragma once

#include <optional>

#include "input/flatlang/trail.h"
#include "popup/diagnostics.h"
#include "popup/part_list.h"

namespace popup::flatlang {

// The parts of a trail, in mm, in the order in which they were begun, and its model.
//
// Besides the trail's polygons, lines of a part whose ends meet in one plane are an outline, in whatever
// strokes they were drawn. The polygons of a part that lie in one plane make its paper by containment: a loop
// in a loop is a hole, one in a hole is paper again. What was drawn before the first part makes a part of
// each outermost loop. Polygons of a part that share an edge in space without lying in one plane are joined
// there by a fold with its angle: they unfold into one piece, with creases; an edge that three share, or
// whose fold would make the piece overlap itself, is cut instead. Parts of one name are numbered ("gear 2");
// those without a name are called "piece".
//
// Errors: `flatlang-no-parts`, when there is no polygon at all; findings about loops that cross one another
// or themselves, or lie askew, are located at the part's beginning. What is no part of a polygon is not cut:
// `flatlang-open-lines`, a remark.
std::optional<PartList> make_parts(const Trail& trail, Diagnostics& diagnostics);

}  // namespace popup::flatlang
