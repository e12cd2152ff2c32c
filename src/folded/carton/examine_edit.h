// What speaks against an edit of a folded shape.
#pragma once

#include <optional>
#include <vector>

#include "folded/carton/move_vertices.h"
#include "folded/carton/vertices.h"
#include "folded/sheet.h"
#include "popup/crease_pattern.h"
#include "popup/diagnostics.h"
#include "popup/geometry.h"

namespace popup::folded {

struct ExaminedEdit {
    Sheet sheet;                 // cut apart, with its new corners
    std::vector<double> angles;  // by fold, radians: those that close it
    double turn_deg = 0.0;       // the most that one of them is another than it was
};

// The sheet with the corners that unfold() gave, folded as its vertices moved: folds between panels that have
// their shapes from vertices as these stand, and flaps that lay on something so that they are parallel to it
// again. nullopt after `edit-refused`, at the crease of a panel: one would have no area
// or lie over another on the sheet, corners that met would not meet again, a panel would turn over, or
// a glue flap would be further from what it lies on, or lie beside it, by more than 0.01 mm. Cost: near
// linear in corners, as long as few panels are near one another.
std::optional<ExaminedEdit> examine_edit(const CreasePattern& pattern, const Vertices& shape,
                                         const MovedVertices& moved, std::vector<Vec2> corners,
                                         Diagnostics& diagnostics);

// Where a panel is drawn: at the crease that it hangs on, or at one of its own.
Place place_of(const CreasePattern& pattern, const Vertices& shape, int panel);

}  // namespace popup::folded
