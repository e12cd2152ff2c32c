// The v-fold: a piece of its own, glued along a V whose apex is on the parent fold (thesis 5.4.3.4).
//
// On the fold's page A B C: seams A–B and B–C, B the apex. On the extra page G E H J I: seams G–E and E–H,
// the piece's outline G E H J I. The author chooses the piece's angle at E; where its centre fold E–F runs
// follows from folding flat: on a valley fold a + g = b + h, on a mountain fold g − a = h − b (a, b the V's
// halves, g, h the piece's).
#include <fmt/format.h>

#include <algorithm>

#include "mechanism/angled.h"
#include "mechanism/fitting.h"
#include "mechanism/measures.h"
#include "mechanism/rows.h"
#include "mechanism/shapes.h"
#include "mechanism/silhouette.h"

namespace popup {
namespace {

constexpr std::array<PointInfo, 8> kPoints{{{"A", PointPage::fold, 'L'},
                                            {"B", PointPage::fold, '-'},
                                            {"C", PointPage::fold, 'R'},
                                            {"G", PointPage::extra, 'L'},
                                            {"E", PointPage::extra, '-'},
                                            {"H", PointPage::extra, 'R'},
                                            {"J", PointPage::extra, 'R'},
                                            {"I", PointPage::extra, 'L'}}};
constexpr std::array<int, 8> kPartners{2, 1, 0, 5, 4, 3, 7, 6};
constexpr std::array<std::string_view, 5> kRing{"G", "E", "H", "J", "I"};
enum : std::size_t { A, B, C };
enum : std::size_t { G, E, H, J, I };

constexpr double kWidestV = 170.0;      // degrees: above, the V hardly moves (thesis)
constexpr double kLeastSurplus = 10.0;  // the piece's angle less the V's (thesis)
constexpr double kMostInAll =
    350.0;  // the piece's angle and the V's: above 360° it locks before the card opens

double v_angle(const Element& e, int dir) {
    return angle_at(e.on[B].s, dir, e.on[A]) + angle_at(e.on[B].s, dir, e.on[C]);
}

// Towards which end of the fold the V opens.
int direction(const Element& e) {
    const double sum = v_angle(e, 1);
    if (std::abs(sum - std::numbers::pi) < e.tolerances->rounding_deg * kDegree) return e.inverted ? -1 : 1;
    return sum < std::numbers::pi ? 1 : -1;
}

std::pair<double, double> stands_on(const Element& e) { return {e.on[B].s, e.on[B].s}; }

double front(const Element& e) { return signed_area(e.extra); }

// The piece's angle at E, through the paper (the ring runs counter-clockwise): in (0, 2π).
double piece_angle(const Element& e) {
    const Vec2 to_g = e.extra[G] - e.extra[E];
    const Vec2 to_h = e.extra[H] - e.extra[E];
    const double angle = std::atan2(cross(to_h, to_g), dot(to_h, to_g));
    return angle > 0.0 ? angle : angle + 2.0 * std::numbers::pi;
}

// g: from the left seam to the centre fold.
double left_far(const Element& e, int dir) {
    const double a = angle_at(e.on[B].s, dir, e.on[A]);
    const double b = angle_at(e.on[B].s, dir, e.on[C]);
    const double lean = e.site.mountain ? a - b : b - a;
    return 0.5 * (piece_angle(e) + lean);
}

// Which edge of the piece the centre fold ends on.
enum class TopEdge { left, top, right };  // I–G, I–J, J–H
struct CentreEnd {
    Vec2 at;
    TopEdge edge = TopEdge::top;
};
std::optional<CentreEnd> centre_end(const Element& e) {
    const Vec2 from = e.extra[E];
    const Vec2 dir = rotated(unit(e.extra[G] - from), -left_far(e, direction(e)));
    std::optional<CentreEnd> best;
    double best_reach = HUGE_VAL;
    const auto look = [&](Vec2 p, Vec2 q, TopEdge edge) {
        const Vec2 along = q - p;
        const double d = cross(dir, along);
        if (d == 0.0) return;
        const double t = cross(p - from, dir) / d;
        const double reach = cross(p - from, along) / d;
        if (t < 0.0 || t > 1.0 || reach <= 1e-9 || reach >= best_reach) return;
        best_reach = reach;
        best = CentreEnd{p + t * along, edge};
    };
    look(e.extra[I], e.extra[J], TopEdge::top);
    look(e.extra[G], e.extra[I], TopEdge::left);
    look(e.extra[J], e.extra[H], TopEdge::right);
    return best;
}

PieceLines piece_lines(const Element& e) {
    const Vec2 from = e.extra[E];
    return {{from, e.extra[G]},
            {from, e.extra[H]},
            "G–E",
            "E–H",
            from,
            rotated(unit(e.extra[G] - from), -left_far(e, direction(e)))};
}

bool constrain_v(Element& e) {
    const Tolerances& tol = *e.tolerances;
    if (!put_apex_on_fold(e, B, "B")) return false;
    int dir = direction(e);
    for (const std::size_t i : {A, C}) {
        const double seam = std::hypot(e.on[i].s - e.on[B].s, e.on[i].w);
        const double angle = angle_at(e.on[B].s, dir, e.on[i]);
        if (seam < tol.min_length_mm || angle < tol.min_angle_deg * kDegree) {
            return angled_degenerate(e, i == A ? "A–B" : "B–C", seam, angle);
        }
    }
    if (e.inverted != (dir < 0)) {
        e.inverted = dir < 0;
        e.repaired("wrong-form",
                   fmt::format("its V opens towards the {} of the parent fold, so it is {} v-fold",
                               dir < 0 ? "begin" : "end", dir < 0 ? "an inverted" : "a"),
                   "change the type, or exchange the ends of the parent fold");
    }
    if (!close_opening(e, e.on[B].s, dir, {A}, {C}, kWidestV)) return false;

    for (const auto& [plane, i] : {std::pair{Side::left, A}, std::pair{Side::right, C}}) {
        const Side side = plane;  // clang 14 cannot capture a structured binding
        const SitePoint apex = e.on[B];
        const SitePoint whole = e.on[i];
        const auto at = [&](double t) { return SitePoint{apex.s + t * (whole.s - apex.s), t * whole.w}; };
        if (e.paper->may_glue(side, e.site.segment(side, apex, whole), Fit::as_drawn)) continue;
        const double t = largest_that_fits(
            [&](double u) { return e.paper->may_glue(side, e.site.segment(side, apex, at(u)), Fit::exact); });
        const double seam = std::hypot(whole.s - apex.s, whole.w);
        const std::string_view name = i == A ? "A–B" : "B–C";
        if (t * seam < tol.min_length_mm) {
            e.failed("does-not-fit", fmt::format("there is no paper under the seam {}", name),
                     "move the apex, or what has been cut out beside it");
            return false;
        }
        e.on[i] = at(t);
        e.repaired("does-not-fit",
                   fmt::format("the seam {} leaves the plane it is glued to; it was shortened from {} to {}",
                               name, mm(seam), mm(t * seam)),
                   "make the V smaller, or the paper under it larger");
    }
    return true;
}

FoldLines fold_lines(const Element& e) {
    const Vec2 from = e.extra[E];
    const auto end = centre_end(e);
    Vec2 f = end ? end->at : 0.5 * (e.extra[I] + e.extra[J]);
    if (const auto drawn = silhouette_of(e, piece_lines(e))) f = drawn->centre.b;
    // The printed side faces a reader at the fold's begin: the outside of a v-fold's V, the inside of an
    // inverted one's.
    const int centre = e.inverted ? 0 : 360;
    const int seams = e.inverted == e.site.mountain ? 0 : 180;
    FoldLines folds(kThreeFolds.size());
    folds[kLeftFold] = {e.site.segment(Side::left, e.on[B], e.on[A]), {from, e.extra[G]}, seams};
    folds[kCentreFold] = {{from, f}, {from, f}, centre};
    folds[kRightFold] = {{from, e.extra[H]}, e.site.segment(Side::right, e.on[B], e.on[C]), seams};
    return folds;
}

// The piece between straight free edges.
Halves straight_halves(const Element& e) {
    const CentreEnd end = centre_end(e).value();
    const Vec2 f = end.at;
    const auto& x = e.extra;
    Halves made;
    switch (end.edge) {
        case TopEdge::left:
            made.left.outer = {x[G], x[E], f};
            made.right.outer = {x[E], x[H], x[J], x[I], f};
            break;
        case TopEdge::top:
            made.left.outer = {x[G], x[E], f, x[I]};
            made.right.outer = {x[E], x[H], x[J], f};
            break;
        case TopEdge::right:
            made.left.outer = {x[G], x[E], f, x[J], x[I]};
            made.right.outer = {x[E], x[H], f};
            break;
    }
    made.edges = {{x[H], x[J]}, {x[J], x[I]}, {x[I], x[G]}};
    return made;
}

Halves halves_of(const Element& e) {
    auto drawn = silhouette_of(e, piece_lines(e));
    return drawn ? std::move(drawn->halves) : straight_halves(e);
}

// Whether the drawn piece stands on its seams: from E its centre fold goes up, and not down through the page.
bool rises(Element& e) {
    const PieceLines lines = piece_lines(e);
    const Silhouette drawn = silhouette_of(e, lines).value();
    const double up = dot(drawn.centre.b - e.extra[E], lines.centre_dir);
    const double down = dot(e.extra[E] - drawn.centre.a, lines.centre_dir);
    if (up > e.tolerances->rounding_mm && down <= e.tolerances->rounding_mm) return true;
    e.failed(
        "outline-off-fold",
        fmt::format("its outline reaches {} beyond its seams at E, to the side on which the page is, and {} "
                    "to the side of J and I",
                    mm(std::max(down, 0.0)), mm(std::max(up, 0.0))),
        "draw the outline on the side of its seams on which J and I are");
    return false;
}

bool constrain_piece(Element& e) {
    const Tolerances& tol = *e.tolerances;
    if (front(e) < 0.0) {
        mirror_piece(e);
        e.repaired("piece-mirrored",
                   "its piece G E H J I was drawn from the back (clockwise); it was mirrored",
                   "draw the printed side: G on the left, H on the right, the seams below");
    }
    if (const std::string what = self_crossing(e.extra, kRing); !what.empty()) {
        e.failed("outline-crosses", "the outline of its piece crosses itself: " + what,
                 "draw G E H J I in this order round the piece");
        return false;
    }
    for (const std::size_t i : {G, H}) {
        const double seam = distance(e.extra[i], e.extra[E]);
        if (seam < tol.min_length_mm) return angled_degenerate(e, i == G ? "G–E" : "E–H", seam, 0.0);
    }
    const int dir = direction(e);
    const double v = v_angle(e, dir);
    const double piece = piece_angle(e);
    const double least = v + kLeastSurplus * kDegree;
    const double most = kMostInAll * kDegree - v;
    const double wanted = std::clamp(piece, std::min(least, most), most);
    if (std::abs(wanted - piece) > tol.rounding_deg * kDegree) {
        const double half = 0.5 * (wanted - piece);
        e.extra[G] = e.extra[E] + rotated(e.extra[G] - e.extra[E], half);
        e.extra[H] = e.extra[E] + rotated(e.extra[H] - e.extra[E], -half);
        if (wanted > piece) {
            e.repaired("piece-too-narrow",
                       fmt::format(
                           "the piece's angle at E is {} and the V's {}: it must be at least {:.0f}° more to "
                           "stand; it was widened to {}",
                           degrees(piece), degrees(v), kLeastSurplus, degrees(wanted)),
                       "close the V, or spread G and H");
        } else {
            e.repaired(
                "piece-too-wide",
                fmt::format(
                    "the piece's angle at E ({}) and the V's ({}) are {} together, and more than {:.0f}° "
                    "lock before the card is open; it was narrowed to {}",
                    degrees(piece), degrees(v), degrees(piece + v), kMostInAll, degrees(wanted)),
                "close the V, or bring G and H together");
        }
    }
    double worst = 0.0;
    for (const auto& [i, on] : {std::pair{G, A}, std::pair{H, C}}) {
        const double seam = std::hypot(e.on[on].s - e.on[B].s, e.on[on].w);
        const Vec2 old = e.extra[i];
        e.extra[i] = e.extra[E] + seam * unit(old - e.extra[E]);
        worst = std::max(worst, distance(old, e.extra[i]));
    }
    if (worst > tol.rounding_mm) {
        e.repaired(
            "seam-length",
            fmt::format("the piece's seams differ from the page's by up to {}; G and H were moved along them",
                        mm(worst)),
            "make G–E as long as A–B, and E–H as long as B–C");
    }
    if (const std::string what = self_crossing(e.extra, kRing); !what.empty()) {
        e.failed("outline-crosses", "with seams that fit, the outline of its piece crosses itself: " + what,
                 "move J and I further from the seams");
        return false;
    }
    const double far = left_far(e, dir);
    if (std::min(far, piece_angle(e) - far) < tol.min_angle_deg * kDegree ||
        (!has_silhouette(e) && !centre_end(e))) {
        e.failed(
            "degenerate",
            fmt::format("its centre fold would run {} from the left seam of a piece of {}, beside the paper",
                        degrees(far), degrees(piece_angle(e))),
            "make the V more even, or the piece wider");
        return false;
    }
    if (has_silhouette(e) && !(constrain_silhouette(e, piece_lines(e)) && rises(e))) return false;
    return constrain_holes(e, halves_of(e), fold_lines(e)[kCentreFold].on_left);
}

bool constrain(Element& e) { return constrain_v(e) && constrain_piece(e); }

void lower(const Element& e, Builder& builder) {
    const int dir = direction(e);
    const auto& x = e.extra;
    const FoldLines folds = fold_lines(e);
    const Vec2 f = folds[kCentreFold].on_left.b;
    GluedShape shape;
    shape.halves = halves_of(e);
    shape.holes = holes_of(e, shape.halves, folds[kCentreFold].on_left).value();
    shape.left_bar = angled_bar(e.site, Side::left, e.on[B].s, dir, e.on[A], x[E], x[G], f);
    shape.right_bar = angled_bar(e.site, Side::right, e.on[B].s, dir, e.on[C], x[E], x[H], f);
    lower_glued(e, builder, folds, std::move(shape));
}

constexpr MeasureInfo kSeamsWidth{
    .name = "width", .about = "how wide it is across the fold, where it is glued", .share = 0.3};
constexpr MeasureInfo kLean{
    .name = "lean",
    .kind = MeasureKind::angle,
    .about = "how much wider the angle of its piece is than that of the V: the more, the further it leans",
    .standard = 40.0};
constexpr MeasureInfo kHeight{.name = "height",
                              .about = "how high the middle of its top edge is above the apex, on the piece",
                              .share = 0.25};
constexpr MeasureInfo kFlare{.name = "flare",
                             .about = "how much wider its top edge is than it is where it is glued",
                             .said = Said::unless_zero};
constexpr MeasureInfo kSway{.name = "sway",
                            .about = "how far right of the apex the middle of its top edge is",
                            .said = Said::unless_zero};
constexpr MeasureInfo kRise{
    .name = "rise", .about = "how much higher the right end of its top edge is", .said = Said::unless_zero};
constexpr std::array<MeasureInfo, 13> kMeasures{
    {measure::kApexAt, kSeamsWidth, measure::kOffset, measure::kAngle, measure::kSkew, kLean, kHeight, kFlare,
     kSway, kRise, measure::kPieceX, measure::kPieceY, measure::kPieceTurn}};

std::vector<double> measured(const Element& e) {
    const int dir = direction(e);
    const auto& x = e.extra;
    const measure::TwoRays m = measure::two_rays(e.site.length, e.on[B].s, dir, e.on[A], e.on[C]);
    const double piece = piece_angle(e);
    const Vec2 up = rotated(unit(x[G] - x[E]), -0.5 * piece);
    const Vec2 top = 0.5 * (x[I] + x[J]) - x[E];
    return {m.at,
            m.width,
            m.offset,
            m.angle,
            m.skew,
            piece / kDegree - m.angle,
            dot(up, top),
            dot(right_of(up), x[J] - x[I]) - m.width,
            dot(right_of(up), top),
            dot(up, x[J] - x[I]),
            x[E].x,
            x[E].y,
            measure::turn_of(up)};
}

void shape(Element& e, std::span<const double> v) {
    const bool drawn = e.extra[E] != e.extra[G];
    // Of one that is still to be made its row tells.
    const int dir = e.on[A].w == 0.0 && e.on[C].w == 0.0 ? (e.inverted ? -1 : 1) : direction(e);
    const measure::TwoRays rays{v[0], v[1], v[2], v[3], v[4], dir};
    e.on[B] = {measure::along(e, v[0]), 0.0};
    e.on[A] = rays.left(e.on[B].s);
    e.on[C] = rays.right(e.on[B].s);
    const std::array<Vec2, 3> before{e.extra[E], e.extra[G], e.extra[H]};
    const measure::Spot spot{{v[10], v[11]}, v[12]};
    const double half = 0.5 * (v[3] + v[5]) * kDegree;
    const auto seam = [&](std::size_t i, double angle) {
        const double size = std::hypot(e.on[i].s - e.on[B].s, e.on[i].w);
        return spot.at + size * rotated(spot.up(), angle);
    };
    e.extra[E] = spot.at;
    e.extra[G] = seam(A, half);
    e.extra[H] = seam(C, -half);
    const double wide = v[1] + v[7];
    e.extra[I] = spot.place(v[8] - 0.5 * wide, v[6] - 0.5 * v[9]);
    e.extra[J] = spot.place(v[8] + 0.5 * wide, v[6] + 0.5 * v[9]);
    if (!drawn) return;
    if (const auto map = measure::mapped_to(before, {e.extra[E], e.extra[G], e.extra[H]}))
        measure::move_drawn(e, PointPage::extra, *map);
}

constexpr ElementRow row(std::string_view name, int code, bool inverted, std::string_view about) {
    return {{.name = name,
             .code = code,
             .family = "v-fold",
             .inverted = inverted,
             .glued = true,
             .about = about,
             .points = kPoints,
             .partners = kPartners,
             .grounds = {.seam = true},
             .parameters = kDrawnHalves,
             .measures = kMeasures},
            stands_on,
            constrain,
            fold_lines,
            front,
            lower,
            nullptr,
            measured,
            shape};
}

}  // namespace

const ElementRow kVFold =
    row("v-fold", 6, false, "a piece glued along a V that opens towards the fold's end");
const ElementRow kInvertedVFold =
    row("inverted-v-fold", 7, true, "a piece glued along a V that opens towards the fold's begin");

}  // namespace popup
