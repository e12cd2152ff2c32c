// The angled step: a beak without its tip (thesis 5.4.3.3).
//
// Points B C on the left side fold and G F on the right one, B and G nearer the apex A, where both side folds
// meet the parent fold; B–G and C–F are the cuts. The centre fold is the beak's.
#include <fmt/format.h>

#include <algorithm>

#include "mechanism/angled.h"
#include "mechanism/fitting.h"
#include "mechanism/measures.h"
#include "mechanism/rows.h"
#include "mechanism/shapes.h"

namespace popup {
namespace {

constexpr std::array<PointInfo, 4> kPoints{{{"B", PointPage::fold, 'L'},
                                            {"C", PointPage::fold, 'L'},
                                            {"G", PointPage::fold, 'R'},
                                            {"F", PointPage::fold, 'R'}}};
constexpr std::array<int, 4> kPartners{2, 3, 0, 1};
enum : std::size_t { B, C, G, F };

// Where the line from the outer point through the inner one meets the fold.
double meets_at(SitePoint inner, SitePoint outer) {
    const double rise = outer.w - inner.w;
    if (std::abs(rise) < 1e-9) return HUGE_VAL;
    return outer.s + (inner.s - outer.s) * outer.w / rise;
}

struct Apex {
    double s = 0.0;
    int dir = 1;
};

Apex apex(const Element& e) {
    const double l = meets_at(e.on[B], e.on[C]);
    const double r = meets_at(e.on[G], e.on[F]);
    Apex result;
    result.s = std::isfinite(l) && std::isfinite(r) ? 0.5 * (l + r) : e.on[B].s;
    const double sum = angle_at(result.s, 1, e.on[C]) + angle_at(result.s, 1, e.on[F]);
    result.dir = sum <= std::numbers::pi ? 1 : -1;
    return result;
}

std::pair<double, double> span(const Element& e) {
    return std::minmax({crossing(e.on[B], e.on[G]), crossing(e.on[C], e.on[F])});
}

// From the fold along the inner cut, the side fold, and back along the outer cut.
Ring half(const Element& e, Side side) {
    const bool left = side == Side::left;
    return {e.site.on_page(side, {crossing(e.on[B], e.on[G]), 0.0}), e.site.on_page(side, e.on[left ? B : G]),
            e.site.on_page(side, e.on[left ? C : F]),
            e.site.on_page(side, {crossing(e.on[C], e.on[F]), 0.0})};
}

// Puts the inner point on the line from the apex to the outer one, at the same distance from the outer one;
// how far it moved.
double align(SitePoint& inner, SitePoint outer, double apex_s) {
    const double size = std::hypot(inner.s - outer.s, inner.w - outer.w);
    const double reach = std::hypot(apex_s - outer.s, outer.w);
    const SitePoint at{outer.s + size / reach * (apex_s - outer.s), outer.w - size / reach * outer.w};
    const double moved = std::hypot(at.s - inner.s, at.w - inner.w);
    inner = at;
    return moved;
}

bool should_be_step(Element& e) {
    e.failed("should-be-step",
             "the sides C–B and F–G are parallel to the fold, or meet it further away than 20 page heights",
             "make it a step, or bring B and G nearer to the fold than C and F");
    return false;
}

bool constrain(Element& e) {
    const Tolerances& tol = *e.tolerances;
    const bool left_swapped = e.on[B].w > e.on[C].w;
    const bool right_swapped = e.on[G].w > e.on[F].w;
    if (left_swapped && right_swapped) {
        std::swap(e.on[B], e.on[C]);
        std::swap(e.on[G], e.on[F]);
        e.repaired("points-reordered",
                   "B and G must be nearer to the apex than C and F; they were exchanged with them",
                   "give B before C and G before F, the inner point first");
    } else if (left_swapped != right_swapped && e.on[B].w != e.on[C].w && e.on[G].w != e.on[F].w) {
        const Segment bg{e.site.on_page(Side::left, e.on[B]), e.site.on_page(Side::right, e.on[G])};
        const Segment cf{e.site.on_page(Side::left, e.on[C]), e.site.on_page(Side::right, e.on[F])};
        const Vec2 at = proper_crossing(bg, cf).value_or(0.5 * (bg.a + bg.b));
        e.failed("outline-crosses", "the cuts B–G and C–F cross at " + at_mm(at),
                 "put B and G at the ends of the cut near the apex, C and F at those of the other");
        return false;
    }
    const double l = meets_at(e.on[B], e.on[C]);
    const double r = meets_at(e.on[G], e.on[F]);
    const auto too_far = [&](double s, std::size_t outer) {
        return !std::isfinite(s) || std::abs(s - e.on[outer].s) > 20.0 * e.page_height;
    };
    if (too_far(l, C) || too_far(r, F)) return should_be_step(e);
    for (const std::size_t i : {B, C, G, F}) {
        if (e.on[i].w < tol.min_length_mm) {
            return angled_degenerate(e, kPoints[i].letter, std::abs(e.on[i].w), 0.0);
        }
    }
    const double mean = 0.5 * (l + r);
    const double moved = std::max(align(e.on[B], e.on[C], mean), align(e.on[G], e.on[F], mean));
    if (moved > tol.rounding_mm) {
        e.repaired("sides-do-not-meet",
                   fmt::format("the sides C–B and F–G meet the fold {} apart; they now meet in one apex",
                               mm(std::abs(l - r))),
                   "choose B on the line from the apex to C, and G on the line from the same apex to F");
    }
    const int dir = apex(e).dir;
    for (const auto& [inner, outer] : {std::pair{B, C}, std::pair{G, F}}) {
        const double size = std::hypot(e.on[outer].s - e.on[inner].s, e.on[outer].w - e.on[inner].w);
        const double angle = angle_at(mean, dir, e.on[outer]);
        if (size < tol.min_length_mm || angle < tol.min_angle_deg * kDegree ||
            e.on[inner].w < tol.min_length_mm) {
            return angled_degenerate(e, inner == B ? "B–C" : "G–F", size, angle);
        }
    }
    if (!close_opening(e, mean, dir, {B, C}, {G, F}, kWidestSlit)) return false;
    return fit_cut(e, {half, span, mean, [&](const Element& x) { return opens_within(x, mean, dir, C, F); }});
}

FoldLines fold_lines(const Element& e) {
    const auto [s, dir] = apex(e);
    const Vec2 b = e.site.on_page(Side::left, e.on[B]);
    const Vec2 c = e.site.on_page(Side::left, e.on[C]);
    const Vec2 g = e.site.on_page(Side::right, e.on[G]);
    const Vec2 f = e.site.on_page(Side::right, e.on[F]);
    const SlitCentre centre = slit_centre(e.site, s, dir, e.on[C], e.on[F]);
    const auto line = [d = dir](Vec2 inner, Vec2 outer) {
        return d > 0 ? Segment{inner, outer} : Segment{outer, inner};
    };
    return slit_folds(
        e.site, line(b, c),
        line(centre.meet(b, g).value_or(lerp(b, g, 0.5)), centre.meet(c, f).value_or(lerp(c, f, 0.5))),
        line(g, f));
}

void lower(const Element& e, Builder& builder) {
    const auto [s, dir] = apex(e);
    const FoldLines folds = fold_lines(e);
    Segment centre = folds[kCentreFold].on_left;
    if (dir < 0) std::swap(centre.a, centre.b);
    const Vec2 a = e.site.on_page(Side::left, {s, 0.0});
    const Vec2 b = e.site.on_page(Side::left, e.on[B]);
    const Vec2 c = e.site.on_page(Side::left, e.on[C]);
    const Vec2 g = e.site.on_page(Side::right, e.on[G]);
    const Vec2 f = e.site.on_page(Side::right, e.on[F]);
    SlitShape shape;
    shape.left = {b, c, centre.b, centre.a};
    shape.right = {centre.a, centre.b, f, g};
    shape.gone_left = half(e, Side::left);
    shape.gone_right = half(e, Side::right);
    shape.cuts = {{b, g}, {c, f}};
    shape.span = span(e);
    shape.left_bar = angled_bar(e.site, Side::left, s, dir, e.on[C], a, c, centre.b);
    shape.right_bar = angled_bar(e.site, Side::right, s, dir, e.on[F], a, f, centre.b);
    lower_slit(e, builder, folds, std::move(shape));
}

constexpr MeasureInfo kFarWidth{
    .name = "width", .about = "how wide it is across the fold, at its far end", .share = 0.35};
constexpr MeasureInfo kSideLength{.name = "length", .about = "how long its side folds are", .share = 0.15};
constexpr std::array<MeasureInfo, 8> kMeasures{{measure::kApexAt, kFarWidth, measure::kOffset,
                                                measure::kAngle, measure::kSkew, kSideLength, measure::kTaper,
                                                measure::kOpens}};

std::vector<double> measured(const Element& e) {
    const auto [s, dir] = apex(e);
    const measure::TwoRays m = measure::two_rays(e.site.length, s, dir, e.on[C], e.on[F]);
    const auto side = [&](std::size_t inner, std::size_t outer) {
        return std::hypot(e.on[outer].s - e.on[inner].s, e.on[outer].w - e.on[inner].w);
    };
    const double left = side(B, C);
    const double right = side(G, F);
    return {
        m.at, m.width, m.offset, m.angle, m.skew, 0.5 * (left + right), right - left, dir > 0 ? 0.0 : 1.0};
}

void shape(Element& e, std::span<const double> v) {
    const measure::TwoRays rays{v[0], v[1], v[2], v[3], v[4], v[7] > 0.5 ? -1 : 1};
    const double s = measure::along(e, v[0]);
    const auto inner = [&](SitePoint outer, double size) {
        const double reach = std::hypot(outer.s - s, outer.w);
        return SitePoint{outer.s + size / reach * (s - outer.s), outer.w - size / reach * outer.w};
    };
    e.on[C] = rays.left(s);
    e.on[F] = rays.right(s);
    e.on[B] = inner(e.on[C], v[5] - 0.5 * v[6]);
    e.on[G] = inner(e.on[F], v[5] + 0.5 * v[6]);
}

constexpr ElementRow row(std::string_view name, int code, bool inverted, std::string_view about) {
    return {{.name = name,
             .code = code,
             .family = "angled-step",
             .inverted = inverted,
             .glued = false,
             .about = about,
             .points = kPoints,
             .partners = kPartners,
             .measures = kMeasures},
            span,
            constrain,
            fold_lines,
            nullptr,
            lower,
            nullptr,
            measured,
            shape};
}

}  // namespace

const ElementRow kAngledStep =
    row("angled-step", 4, false, "two cuts across a valley fold; a beak without its tip");
const ElementRow kInvertedAngledStep =
    row("inverted-angled-step", 5, true, "an angled step on a mountain fold");

}  // namespace popup
