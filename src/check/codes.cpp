#include "check/codes.h"

#include <array>

namespace popup {
namespace {

constexpr std::array kCheckCodes = std::to_array<CodeInfo>({
    {"copy-on-original", Severity::warning, "a copy was not moved",
     "Two elements that are cut from one page have the same points. The first takes the paper there, so the "
     "second comes to stand on the folds of the first, in another form and size than it was drawn with, or "
     "cannot be made. Move one of them along the fold, or delete it."},
    {"cut-on-seam", Severity::error, "a 90° element stands on a glued seam",
     "Steps, beaks and angled steps are cut across the fold they stand on. A seam is two pieces of paper "
     "glued together, so the cut would go through the glue and part what holds the design together. Stand "
     "a tent or a v-fold on the seam instead, or cut a fold of the piece."},
    {"dropped", Severity::warning, "an element was taken out",
     "With --drop, elements that are too small to fold are taken out of the document, and with them "
     "everything that stands on them; pages of pieces that went are closed up. The document before is "
     "unchanged unless it is written over."},
    {"folds-crossed", Severity::error, "an outline lies across several folds",
     "An element that is cut from one sheet stands on the fold that its outline crosses exactly twice, and "
     "need "
     "not name it. This outline crosses several folds twice, as one does that is drawn over a step and over "
     "the gutter beside it, so there is no telling which is meant. Name the fold by its parentfold, or draw "
     "the outline across one fold alone."},
    {"fold-cut-away", Severity::error, "the parent fold has been cut away where the element stands",
     "A 90° element takes away the stretch of its parent fold that lies between its cuts; what remains "
     "there are its own side folds and centre fold. An element that comes later in the list can stand on "
     "those, or beside them, but not on the fold that is gone. Its parent fold may lie on the same line as "
     "the old one: then only the place along it counts."},
    {"fold-not-found", Severity::error, "there is no fold where an element should stand",
     "A structure names its parent fold by two points of it. No fold or seam of the page or of an earlier "
     "structure lies within 5 mm of that line beside the element. The list is in build order, parents "
     "first, and the points are in the coordinates of the page given. The message names the nearest fold "
     "and its distance. Where the line lies along a part of a fold, beside it, an element that stood on that "
     "fold has most likely been taken out: then the message says so."},
    {"fold-snapped", Severity::warning, "the parent fold was given a little beside the real one",
     "The two points given for the parent fold lie up to 5 mm beside a fold or seam, so that one is meant. "
     "The element's own points stay where they are; its parent fold now runs along the real fold."},
    {"fold-turned", Severity::remark, "the gutter was given downwards",
     "Left and right are seen from a fold's begin to its end. The gutter always runs upwards, so a "
     "structure that gives it downwards is read with its sides exchanged, and a v-fold as its inverse. The "
     "document stays as it is; nothing needs mending."},
    {"fold-without-direction", Severity::error, "a parent fold begins and ends in the same point",
     "A parent fold is named by two distinct points of it. They say which fold is meant and in which "
     "direction it is looked along, and so which side is left. Here both points are the same, to within "
     "the rounding of a drawing. Give the two ends of the fold."},
    {"moved-with-fold", Severity::warning, "an element moved because its fold was repaired",
     "Elements keep their place relative to the fold they stand on. A repair moved that fold, so the "
     "element was moved, or turned, with it. Mending the element below makes this repair unnecessary. The "
     "same is done where an element still names the place at which its fold was before somebody moved what "
     "makes it: one fold of the same length is clearly the nearest, at most 50 mm away."},
    {"no-fold-crossed", Severity::error, "an outline lies across no fold",
     "An element that is cut from one sheet stands on the fold that its outline crosses exactly twice, once "
     "on "
     "the way over and once on the way back. Where earlier elements have cut the fold away it does not "
     "count. "
     "The message says which folds the outline crosses otherwise, or which one is the nearest. Draw it so "
     "that it lies on both sides of its fold."},
    {"page-not-there", Severity::error, "a page is named that does not exist yet",
     "Page 0 is the base page. Every v-fold and every tent adds one page for its own piece: page 1 for the "
     "first of them in the list, 2 for the second. An element or a drawn line can only be on a page whose "
     "piece is listed before it."},
    {"plate-not-found", Severity::error, "there is no plate where an element should stand",
     "A structure names its parent plate by any point of it. Neither the page nor an earlier structure has "
     "paper there: the point lies beside all plates of that page, or where one has been cut out. The list is "
     "in build order, parents first, and the point is in the coordinates of the page given."},
    {"seam-stays-flat", Severity::error, "an element stands on a seam that does not fold",
     "The plates on both sides of this seam lie in one plane, facing the same way, when the card is "
     "closed. Nothing that stands across such a seam can fold flat. Seams of v-folds and tents on valley "
     "folds do open and close."},
    {"points-exchanged", Severity::error, "points are exchanged",
     "The element cannot be made of its points in the order given, and could be made without moving any if "
     "two, or twice two, of them changed places. The hint names the fewest that do. The manual page popup(5) "
     "gives the order of the points for each type."},
    {"sides-exchanged", Severity::warning, "left and right points were exchanged",
     "Left is the left-hand side when looking from the parent fold's begin to its end. All points given as "
     "left lie right of it and the other way round, so the points changed places. The colours go with them: "
     "a plate that was mirrored with its points keeps its colour. Of a piece whose own points are drawn the "
     "right way round, the colours stay where they are."},
    {"wrong-ground", Severity::error, "an element stands on what it cannot stand on",
     "Some elements stand on folds or seams, which parentfold names, and some on plates, which parentplate "
     "names by any point of them. `popupc list elements` and popup(5) say which."},
    {"wrong-page", Severity::error, "a point lies on a page that its parent fold is not on",
     "Points of an element lie on the planes beside its parent fold. On a seam these planes are on two "
     "pages: each point must name the page of its side. On a fold both sides are on one page."},
});

}  // namespace

std::span<const CodeInfo> check_codes() { return kCheckCodes; }

}  // namespace popup
