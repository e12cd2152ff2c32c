// The parts of what is cut from one sheet, for the shapes that are made of them: those whose folds are
// parallel (sheet_shape.h) and those whose folds meet in a point (v_fold_cut.cpp). Coordinates are those of
// the site: x along the fold, y to its left.
#pragma once

#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "mechanism/divide.h"
#include "mechanism/sheet_shape.h"

namespace popup {

// Begins the border with its edge along the fold, which it has.
void begin_at_drive(Border& border);
// The part that has an edge along the fold, begun with it.
Border part_with_drive(const Division& division);

// Makes side folds of the edges that lie on the line, one of each stretch; what is shorter than kLeastEdgeMm
// stays a cut. The first edge must not lie on it. False: there is none.
bool put_stretches(Border& border, const DirectedLine& line);

// The wider side of the fold divided by the centre fold, and the narrower one with what it is level with.
struct Panels {
    std::vector<Border> far;  // that hang on the side fold of the wider side; by the longest stretch of it
    Border near;              // the rest, over the fold to the other side fold
};
// Of two borders that have the edge along the fold in common, the wider one above it; its side fold lies
// above the centre fold, which points away from its begin at the fold, if they meet. nullopt: no such two
// halves.
std::optional<Panels> panels_of(const Border& wide, const Border& narrow, const DirectedLine& centre);

// Both sides meet in the fold itself, which is the centre fold, too.
void fold_in_the_middle(Border& side);

struct SheetParts {
    Border upper, lower;         // what lies on the left and on the right of the fold; begun with the fold
    std::vector<Border> plates;  // left, right, and more on the wider side
    bool far_left = true;        // that is the left one
    std::pair<double, double> span;  // of the fold, mm along it
};
// The shape without its bars. `along`: whether a stretch of a fold runs as folds of its kind do.
std::optional<SheetFault> finish(const Element& e, const SheetParts& parts,
                                 const std::function<bool(const Segment&)>& along, CutShape& into);

SheetFault not_divided();

}  // namespace popup
