// What several elements share: fitting onto the paper, bars of linkages, and lowering.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mechanism/element.h"

namespace popup {

constexpr double kDegree = std::numbers::pi / 180.0;

// Where the folds of a linkage of four stand in kThreeFolds.
enum ThreeFolds : std::size_t { kLeftFold, kCentreFold, kRightFold };

inline Side other(Side side) { return side == Side::left ? Side::right : Side::left; }

// Angle between the direction `dir` (+1 or -1) along the fold and the line from the apex to p; in (0, π) for
// w > 0.
double angle_at(double apex_s, int dir, SitePoint p);
// p turned about the apex so that its angle_at becomes `angle`, at the same distance.
SitePoint at_angle(double apex_s, int dir, SitePoint p, double angle);
// Where the line from l (left of the fold) to r (right of it) crosses the fold.
double crossing(SitePoint l, SitePoint r);
// The point of the line l–r whose distance from the fold, on l's side, is w (negative: beyond the fold).
SitePoint along_cut(SitePoint l, SitePoint r, double w);

// Where segments a and b cross properly, if they do.
std::optional<Vec2> proper_crossing(const Segment& a, const Segment& b);
// The first self-crossing of a ring of a few points, in words ("G–I crosses E–H at (1.00, 2.00) mm"); empty:
// none.
std::string self_crossing(const Ring& ring, std::span<const std::string_view> letters);

// "12.34 mm", "5.67°", "(1.20, 3.40) mm"; never "-0.00".
std::string at_mm(Vec2 p);
std::string mm(double value);
std::string degrees(double radians);

// Turns both pairs (a, b), which should run along the fold, about their midpoints until they do; a repair
// where the deviation is more than rounding. `name` is the line's ("A–B").
void make_parallel(Element& element, std::size_t a, std::size_t b, std::string_view name);

// The largest t in (0, 1] for which ok(t), which is assumed to hold below it as well; 0 when it holds
// nowhere.
double largest_that_fits(const std::function<bool(double)>& ok);

// Makes a cut element fit on its paper: pulled towards the fold on the side where it is too large, else
// shortened along the fold about `fixed_s`, else both. `footprint` gives a side's half from the points as
// they are, `span` the stretch of the fold between the cuts. False after failed().
struct Footprint {
    std::function<Ring(const Element&, Side)> half;
    std::function<std::pair<double, double>(const Element&)> span;
    double fixed_s = 0.0;
    std::function<bool(const Element&)> valid =
        nullptr;  // what else must hold of the smaller element; none: nothing
};
bool fit_cut(Element& element, const Footprint& footprint);

// Bars of linkages. Plates are filled in by the lowering functions.
Bar angled_bar(const Site& site, Side side, double apex_s, int dir, SitePoint seam_end, Vec2 own_apex,
               Vec2 own_seam_end, Vec2 own_centre_end);
// `own_along` and `own_across` are directions on the element plate's page: along the fold, and from the seam
// towards the centre fold.
Bar parallel_bar(const Site& site, Side side, SitePoint seam_point, Vec2 own_point, Vec2 own_along,
                 Vec2 own_across, double far);

// The folds of a 90° element: those at its sides close like the fold it stands on, the one between them the
// other way.
FoldLines slit_folds(const Site& site, Segment left, Segment centre, Segment right);

// A 90° element's shape, in site coordinates of the left side (w positive to the left of the fold).
struct SlitShape {
    Ring left, right;                // the two element plates, page coordinates
    Ring gone_left, gone_right;      // what the planes lose: paths from the fold and back, page coordinates
    std::vector<Segment> cuts;       // page coordinates
    std::pair<double, double> span;  // of the fold that is lost
    bool parallel = false;
    Bar left_bar, right_bar;
};
void lower_slit(const Element& element, Builder& builder, const FoldLines& folds, SlitShape shape);

// A 180° element's shape.
struct GluedShape {
    Ring left, right;            // extra page coordinates
    std::vector<Segment> edges;  // free edges of the piece
    bool parallel = false;
    Bar left_bar, right_bar;
};
void lower_glued(const Element& element, Builder& builder, const FoldLines& folds, GluedShape shape);

}  // namespace popup
