// Edits of a folded sheet in space: the layout on the sheet follows (Folding Cartons, section 5.2).
//
//     const SheetEdit higher{SheetEdit::Kind::extrude, {"top"}, {}, false, 10.0};
//     const std::optional<EditedSheet> box = edit_sheet(pattern, {}, {}, higher, diagnostics);
//     if (box) pattern.lines[0].points = box->lines[0].points;
//
// Places in space are those of the folded shape: the largest panel of a piece lies where it is drawn, x goes
// to the right of the drawing, y up, and z towards the viewer; mm.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "popup/crease_pattern.h"
#include "popup/diagnostics.h"
#include "popup/geometry.h"
#include "popup/refinement.h"

namespace popup {

struct SheetEdit {
    enum class Kind { vertex, edge, extrude };
    Kind kind = Kind::vertex;
    // "front.2" or "front+right+top" (the panels that meet there) of a vertex, "front.2-3" or "front+top"
    // (the fold between them) of an edge, "top" of a panel.
    std::string name;
    Vec3 by;              // of vertices and edges: how far, or where to, mm
    bool to = false;      // `by` is a place; of an edge that of its middle
    double out_mm = 0.0;  // of a panel: outwards, away from the middle of the shape; less than 0: inwards
};

struct EditedSheet {
    // By line of the pattern.
    struct Line {
        std::vector<Vec2> points;  // as many as it had
        bool moved = false;
        // Corners of the sheet that lay on the line, and have left it. It bends through them, in this order,
        // between the point of that number and the next.
        std::vector<std::pair<int, Vec2>> through;
        // Not empty: what one line was cannot be one line any more, because what lies on its two sides goes
        // apart. These are all the edges that it stood for.
        std::vector<Segment> parted;
        // Not empty: how far it is folded now, degrees as fold_by() takes them. One for all of it, or one for
        // each of `parted`: of folds that lie on one line and are folded by different angles. Where a drawing
        // cannot say that, `points` are where the line is. Of `parted` those come last that fold nothing, as
        // between two flaps: they have none.
        std::vector<double> fold_deg = {};
    };
    std::vector<Line> lines;
    int moved_corners = 0;  // of the sheet
    double most_mm = 0.0;   // that a corner of the sheet has moved
    double turn_deg = 0.0;  // the most that a fold has to go further, or less far, than it did
    // The folded shape before and after, closed: every fold at its angle, for fold_sheet().
    CreasePattern before, after;
    struct Name {
        std::string was, is;  // "sheet/front"
        Place place = {};     // of one of its creases
    };
    std::vector<Name> names;  // of panels, which are guessed by their sizes, in the moved lines
};

// Moves a vertex, an edge or a face of the shape in which the motion of fold_sheet() ends, refined by
// `joins`. Corners of panels that are in one place in that shape, to a hundredth of the sheet but 10 mm
// at most (for creases have allowances for the board), move together, and an extruded panel takes along those
// that lie in its plane. The panels they belong to stay plane: the places of the other vertices with the
// least sum of squares of their moves for which that holds. Flaps that meet nothing else follow the crease
// that they hang on; where that grows, they grow in their middle third, so that their corners keep their
// shape. The sheet is then unfolded anew, from the largest panel that did not move.
//
// Errors, and nullopt: `bad-edit` (there is no such vertex, edge or panel), `edit-refused` (a panel would
// have to bend, to have no area, or to lie over another on the sheet; the folds around a corner or a hole
// would not lie flat; what met would not meet again, by more than 0.01 mm, however the folds are folded; a
// glue flap would be more than 0.01 mm further from what it lies on, or lie beside it), with the place of a
// crease of that panel; those of rough shapes (`not-refined`, fold_sheet()'s). The remark `folds-turn` says
// that folds have to be folded otherwise than the drawing said for it to close; its lines have the angles,
// but where the options end the motion before. Cost: some sparse factorisations with three unknowns a vertex,
// and near linear in corners.
std::optional<EditedSheet> edit_sheet(const CreasePattern& pattern, const FoldOptions& options,
                                      const std::vector<Join>& joins, const SheetEdit& edit,
                                      Diagnostics& diagnostics);

// The vertices and edges of a folded sheet by the names that edits take, with their places on the sheet and
// in the folded shape.
struct ShownSheet {
    struct Vertex {
        std::string name;                // "front.2"
        Vec2 flat;                       // mm
        Vec3 at;                         // mm
        std::vector<std::string> meets;  // vertices of other panels that move with it
    };
    struct Edge {
        std::string name;   // "front.2-3"
        std::string other;  // of a fold: the panel on its other side
        double length_mm = 0.0;
    };
    struct Panel {
        std::string name;
        Vec3 out;  // unit
        std::vector<Vertex> vertices;
        std::vector<Edge> edges;  // from each vertex to the next
    };
    std::vector<Panel> panels;
};
std::optional<ShownSheet> show_sheet(const CreasePattern& pattern, const FoldOptions& options,
                                     const std::vector<Join>& joins, Diagnostics& diagnostics);

}  // namespace popup
