// The pivot: a beak, and a flat piece glued on one of its planes. As the fold opens the plane turns about its
// side fold, and the piece swings out far beyond it, or tucks away (Glassner, section 7, figure 9).
//
// Points A, B, E as the beak's. The line G–H of the piece lies on the side fold of the plane that it is glued
// on: A–B, or A–E with side="right". Where the beak's cut would run along a straight edge of its planes, as
// at the end of a strap, none is cut.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/geometry/regions.h"
#include "mechanism/attach.h"
#include "mechanism/beak.h"
#include "mechanism/fitting.h"
#include "mechanism/measures.h"
#include "mechanism/rows.h"
#include "mechanism/site_lines.h"

namespace popup {
namespace {

using beak::A, beak::B, beak::E;

constexpr std::array<PointInfo, 5> kPoints{{{"A", PointPage::fold, '-'},
                                            {"B", PointPage::fold, 'L'},
                                            {"E", PointPage::fold, 'R'},
                                            {"G", PointPage::extra, '-'},
                                            {"H", PointPage::extra, '-'}}};
constexpr std::array<int, 5> kPartners{0, 2, 1, 3, 4};
constexpr std::array<std::string_view, 2> kSides{"left", "right"};
constexpr std::array<ParameterInfo, 6> kParameters{{kHalfColours[0],
                                                    kHalfColours[1],
                                                    kAttachedColor,
                                                    kAttachedOutline,
                                                    kAttachedGlue,
                                                    {.name = "side",
                                                     .kind = ParameterKind::choice,
                                                     .about = "plane of the beak on which the piece is glued",
                                                     .partner = "side",
                                                     .words = kSides}}};
constexpr std::array<FoldInfo, 3> kFolds{{{"left", PointPage::fold, PointPage::fold},
                                          {"centre", PointPage::fold, PointPage::fold},
                                          {"right", PointPage::fold, PointPage::fold}}};

constexpr double kCollinearMm = 1e-6;

// The straight edges of both planes that B and E lie on, from the end of the fold.
struct Flush {
    double end = 0.0;  // where the fold ends, mm along it
    Segment left, right;
};

std::optional<Flush> flush_edges(const Element& e) {
    const double crossing_s = crossing(e.on[B], e.on[E]);
    const double rounding = e.tolerances->rounding_mm;
    for (const double end : {e.alive_lo, e.alive_hi}) {
        if (std::abs(crossing_s - end) > rounding) continue;
        const auto edge = [&](Side side, SitePoint p) {
            return e.paper->edge_along(side, e.site.segment(side, {end, 0.0}, p));
        };
        const auto left = edge(Side::left, e.on[B]);
        const auto right = edge(Side::right, e.on[E]);
        if (left && right) return Flush{end, *left, *right};
    }
    return std::nullopt;
}

// Puts a point exactly on an edge, `t` of its way from the end of the fold.
SitePoint on_edge(const Element& e, Side side, const Segment& edge, double end, SitePoint p, double t) {
    const Vec2 along = unit(edge.b - edge.a);
    const Vec2 from = e.site.on_page(side, {end, 0.0});
    const double reach = dot(along, e.site.on_page(side, p) - from);
    return e.site.from_page(side, from + (t * reach) * along);
}

// Makes B and E lie on the edges, as far out as there is paper; false after failed().
bool fit_flush(Element& e, const Flush& flush) {
    const Element drawn = e;
    const auto at = [&](double t) {
        Element made = drawn;
        made.on[B] = on_edge(drawn, Side::left, flush.left, flush.end, drawn.on[B], t);
        made.on[E] = on_edge(drawn, Side::right, flush.right, flush.end, drawn.on[E], t);
        return made;
    };
    const auto ok = [&](double t, Fit fit) {
        const Element made = at(t);
        return std::abs(crossing(made.on[B], made.on[E]) - flush.end) <= kCollinearMm &&
               beak::opens_within_limit(made) &&
               e.paper->may_cut_to(Side::left, beak::half(made, Side::left), flush.left, fit) &&
               e.paper->may_cut_to(Side::right, beak::half(made, Side::right), flush.right, fit);
    };
    if (ok(1.0, Fit::as_drawn)) {
        e = at(1.0);
        return true;
    }
    const double t = largest_that_fits([&](double u) { return ok(u, Fit::exact); });
    const Element made = at(t);
    if (t == 0.0 || std::min(made.on[B].w, made.on[E].w) < e.tolerances->min_length_mm) {
        e.failed("does-not-fit", "there is no room for it along the edge that B and E lie on",
                 "move what stands beside it, or draw A, B and E inside the planes");
        return false;
    }
    e = made;
    e.repaired("does-not-fit",
               fmt::format("it is larger than the planes it stands on; B and E were pulled towards the fold, "
                           "along the edge, to {:.1f} %",
                           100.0 * t),
               "make it smaller, or the paper around it larger");
    return true;
}

bool on_right(const Element& e) { return choice_of(e, "side") == kSides[1]; }

Bed bed_of(const Element& e) {
    const std::size_t tip = on_right(e) ? E : B;
    const Vec2 apex = e.site.on_page(Side::left, e.on[A]);
    const SlitShape shape = beak::shape_of(e, beak::fold_lines(e));
    const Ring plane = on_right(e) ? shape.right : shape.left;
    return {{apex, e.site.on_page(on_right(e) ? Side::right : Side::left, e.on[tip])},
            false,
            [plane](double inset, const Box&) {
                Polygon paper{plane, {}};
                if (signed_area(paper.outer) < 0.0) std::reverse(paper.outer.begin(), paper.outer.end());
                return offset({paper}, -inset, Corners::sharp);
            }};
}

bool constrain(Element& e) {
    if (const auto flush = flush_edges(e)) {
        if (!beak::constrain_sides(e) || !fit_flush(e, *flush)) return false;
    } else if (!beak::constrain(e)) {
        return false;
    }
    const Bed bed = bed_of(e);
    return constrain_line(e, bed, on_right(e) ? "A–E" : "A–B") && constrain_attached(e, bed);
}

void lower(const Element& e, Builder& builder) {
    const FoldLines folds = beak::fold_lines(e);
    SlitShape shape = beak::shape_of(e, folds);
    if (const auto flush = flush_edges(e)) {
        shape.cuts.clear();
        for (const Side side : {Side::left, Side::right}) {
            Ring& gone = side == Side::left ? shape.gone_left : shape.gone_right;
            gone.back() = e.site.on_page(side, {flush->end, 0.0});
        }
        (shape.span.first < e.on[A].s ? shape.span.first : shape.span.second) = flush->end;
    }
    const SlitPlates plates = lower_slit(e, builder, folds, std::move(shape));
    lower_attached(e, bed_of(e), builder, on_right(e) ? plates.right : plates.left);
}

constexpr MeasureInfo kPieceWidth{
    .name = "piecewidth", .about = "width of its piece's outline, across the side fold", .share = 0.15};
constexpr MeasureInfo kPieceHeight{
    .name = "pieceheight", .about = "height of its piece's outline, along the side fold", .share = 0.3};
constexpr std::array<MeasureInfo, 11> kMeasures = [] {
    std::array<MeasureInfo, 11> all{};
    std::copy(beak::kMeasures.begin(), beak::kMeasures.end(), all.begin());
    all[6] = kPieceWidth;
    all[7] = kPieceHeight;
    all[8] = measure::kPieceX;
    all[9] = measure::kPieceY;
    all[10] = measure::kPieceTurn;
    return all;
}();

// The side fold that G–H lies on, on its page.
Segment line_on_page(const Element& e) {
    const std::size_t tip = on_right(e) ? E : B;
    return {e.site.on_page(Side::left, e.on[A]),
            e.site.on_page(on_right(e) ? Side::right : Side::left, e.on[tip])};
}

std::vector<double> measured(const Element& e) {
    std::vector<double> made = beak::measured(e);
    const AttachedMeasures piece = attached_measures(e);
    made.insert(made.end(), {piece.width, piece.height, piece.line.at.x, piece.line.at.y, piece.line.turn});
    return made;
}

void shape(Element& e, std::span<const double> v) {
    const Segment was = line_on_page(e);
    beak::shape(e, v);
    const Segment line = line_on_page(e);
    // On the plane's side of the fold, and away from its apex: what lies beyond the fold goes through the
    // page as the plane turns.
    const double beside = on_right(e) ? -0.5 : 0.5;
    const measure::Scale scale =
        shape_attached(e, {v[6], v[7], {{v[8], v[9]}, v[10]}}, distance(line.a, line.b), beside, 0.25);
    if (was.a == was.b) return;
    measure::move_drawn(e, PointPage::fold,
                        measure::moved_to(measure::spot_of(was.a, was.b), measure::spot_of(line.a, line.b),
                                          scale.aside, scale.along));
}

}  // namespace

const ElementRow kPivot = {{.name = "pivot",
                            .code = -1,
                            .family = "pivot",
                            .inverted = false,
                            .glued = true,
                            .about = "a beak with a piece on one of its planes, which swings out with it",
                            .points = kPoints,
                            .partners = kPartners,
                            .parameters = kParameters,
                            .folds = kFolds,
                            .since = "3.0",
                            .measures = kMeasures},
                           beak::span,
                           constrain,
                           beak::fold_lines,
                           drawn_from_front,
                           lower,
                           nullptr,
                           measured,
                           shape};

}  // namespace popup
