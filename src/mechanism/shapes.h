// The shapes that linkages of four folds lower themselves into: two halves cut from a page, or glued on one.
#pragma once

#include <utility>
#include <vector>

#include "mechanism/element.h"
#include "mechanism/holes.h"
#include "mechanism/site_lines.h"

namespace popup {

// Where the folds of a linkage of four stand in kThreeFolds.
enum ThreeFolds : std::size_t { kLeftFold, kCentreFold, kRightFold };

// Bars of linkages. Plates are filled in by the lowering functions.
Bar angled_bar(const Site& site, Side side, double apex_s, int dir, SitePoint seam_end, Vec2 own_apex,
               Vec2 own_seam_end, Vec2 own_centre_end);
// `own_along` and `own_across` are directions on the element plate's page: along the fold, and from the seam
// towards the centre fold.
Bar parallel_bar(const Site& site, Side side, SitePoint seam_point, Vec2 own_point, Vec2 own_along,
                 Vec2 own_across, double far);

// Adds one of the element's folds, between two of the plates; gives its number among the skeleton's. Its
// pages, and whether it is a seam, follow from the row.
struct PlatesOfFold {
    int left, right;
};
int add_fold_of(const Element& element, Builder& builder, const FoldLines& folds, std::size_t which,
                PlatesOfFold plates);

// Glues a piece on both sides of the fold it stands on: the tabs "1L" and "1R" along its two seams.
struct SeamOfPlate {
    const FoldLine& line;
    int plate;
};
void glue_seams(const Element& element, Builder& builder, const SeamOfPlate& left, const SeamOfPlate& right);

// The folds of a 90° element: those at its sides close like the fold it stands on, the one between them the
// other way.
FoldLines slit_folds(const Site& site, Segment left, Segment centre, Segment right);

// A further fold of a 90° element whose row's folds have several stretches.
struct SlitFold {
    std::size_t which = kLeftFold;  // of the row's folds: it lies between the same planes
    Segment line;                   // page coordinates, along the fold that the element stands on
    std::size_t plate = 0;  // of a side fold its element plate: 0 left, 1 right, 2 the first of `more`
    std::size_t other = 1;  // of a centre fold the plate on its right
};

// A 90° element's shape, in site coordinates of the left side (w positive to the left of the fold).
struct SlitShape {
    Ring left, right;                // the two element plates, page coordinates
    Ring gone_left, gone_right;      // what the planes lose: paths from the fold and back, page coordinates
    std::vector<Segment> cuts;       // page coordinates
    std::pair<double, double> span;  // of the fold that is lost
    bool parallel = false;
    Bar left_bar, right_bar;
    // Parts of the left half (or of the right one) beside the first, on other stretches of the same fold:
    // they move with it.
    std::vector<Ring> more = {};
    Side more_on = Side::left;
    std::vector<SlitFold> more_folds = {};
};
struct SlitPlates {
    int left, right;
};
SlitPlates lower_slit(const Element& element, Builder& builder, const FoldLines& folds, SlitShape shape);

// A 180° element's shape.
struct GluedShape {
    Halves halves;
    PieceHoles holes;
    bool parallel = false;
    bool right_angle = false;  // moves as a parallelogram, so that it is flat on the open card, too
    Bar left_bar, right_bar;
};
void lower_glued(const Element& element, Builder& builder, const FoldLines& folds, GluedShape shape);

}  // namespace popup
