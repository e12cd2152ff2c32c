// Holes of pieces that a centre fold divides: v-folds, tents, layers. They are the subpaths of a drawn
// outline that lie inside it, and those of the parameter `hole`.
//
//     if (!constrain_holes(e, halves, centre)) return false;            // in constrain()
//     shape.holes = holes_of(e, halves, centre).value();                // in lower()
#pragma once

#include <optional>
#include <vector>

#include "mechanism/element.h"

namespace popup {

// A piece that its centre fold divides, in coordinates of its own page.
struct Halves {
    Polygon left, right;
    std::vector<Segment> edges;  // what is cut: free edges, those of holes aside
};

// A hole that crosses the centre fold: on either side a path from the fold and back.
struct HoleAcross {
    Ring left, right;
    double from = 0.0, to = 0.0;  // along the centre fold, from its begin
};

struct PieceHoles {
    std::vector<Ring> left, right;  // clockwise
    std::vector<HoleAcross> across;
    std::vector<Segment> edges;  // all that is cut
};

bool has_holes(const Element& e);
// The holes as drawn; nullopt where one is not as it must be.
std::optional<PieceHoles> holes_of(const Element& e, const Halves& halves, const Segment& centre);
// Mends holes that overlap or cross themselves (mend_holes()), looks whether all lie inside the piece and
// leave a centre fold that holds; false after failed(): `hole-off-piece`. Warns of paper that is too thin, in
// drawn pieces and beside holes.
bool constrain_holes(Element& e, const Halves& halves, const Segment& centre);

// Where a ring crosses a line, in order along it.
struct FoldCrossing {
    double along = 0.0;
    std::size_t corner = 0;
};
// Corners that lie on the line are put there exactly. Where the ring only touches the line, or runs along it,
// is no crossing.
std::vector<FoldCrossing> put_crossings(Ring& ring, const DirectedLine& fold);

}  // namespace popup
