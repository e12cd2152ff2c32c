// The beak: one cut across the fold; two side folds and the centre fold meet in the apex on it
// (thesis 5.4.3.2).
//
// Points A (apex), B left, E right; B–E is the cut. With a and b the angles of the side folds to the parent
// fold, the centre fold leaves the left side fold at the angle b (so the right one at a), which makes every
// angle foldable.
#include "mechanism/beak.h"

#include <fmt/format.h>

#include <algorithm>

#include "mechanism/angled.h"
#include "mechanism/fitting.h"
#include "mechanism/rows.h"

namespace popup {

namespace beak {

int direction(const Element& e) {
    return angle_at(e.on[A].s, 1, e.on[B]) + angle_at(e.on[A].s, 1, e.on[E]) <= std::numbers::pi ? 1 : -1;
}

std::vector<double> measured(const Element& e) {
    const measure::TwoRays m = measure::two_rays(e.site.length, e.on[A].s, direction(e), e.on[B], e.on[E]);
    return {m.at, m.width, m.offset, m.angle, m.skew, m.dir > 0 ? 0.0 : 1.0};
}

void shape(Element& e, std::span<const double> v) {
    const measure::TwoRays rays{v[0], v[1], v[2], v[3], v[4], v[5] > 0.5 ? -1 : 1};
    e.on[A] = {measure::along(e, v[0]), 0.0};
    e.on[B] = rays.left(e.on[A].s);
    e.on[E] = rays.right(e.on[A].s);
}

std::pair<double, double> span(const Element& e) {
    return std::minmax(e.on[A].s, crossing(e.on[B], e.on[E]));
}

// From the apex along the side fold and back to the fold along the cut.
Ring half(const Element& e, Side side) {
    return {e.site.on_page(side, e.on[A]), e.site.on_page(side, e.on[side == Side::left ? B : E]),
            e.site.on_page(side, {crossing(e.on[B], e.on[E]), 0.0})};
}

bool constrain_sides(Element& e) {
    const Tolerances& tol = *e.tolerances;
    if (!put_apex_on_fold(e, A, "A")) return false;
    for (const std::size_t i : {B, E}) {
        const double reach = std::hypot(e.on[i].s - e.on[A].s, e.on[i].w);
        const double angle = angle_at(e.on[A].s, direction(e), e.on[i]);
        if (reach < tol.min_length_mm || angle < tol.min_angle_deg * kDegree ||
            e.on[i].w < tol.min_length_mm) {
            return angled_degenerate(e, i == B ? "A–B" : "A–E", reach, angle);
        }
    }
    return close_opening(e, e.on[A].s, direction(e), {B}, {E}, kWidestSlit);
}

bool opens_within_limit(const Element& e) { return opens_within(e, e.on[A].s, direction(e), B, E); }

bool constrain(Element& e) {
    if (!constrain_sides(e)) return false;
    const int dir = direction(e);
    return fit_cut(e, {half, span, e.on[A].s,
                       [dir](const Element& x) { return opens_within(x, x.on[A].s, dir, B, E); }});
}

FoldLines fold_lines(const Element& e) {
    const int dir = direction(e);
    const Vec2 a = e.site.on_page(Side::left, e.on[A]);
    const Vec2 b = e.site.on_page(Side::left, e.on[B]);
    const Vec2 end = e.site.on_page(Side::right, e.on[E]);
    const SlitCentre centre = slit_centre(e.site, e.on[A].s, dir, e.on[B], e.on[E]);
    const Vec2 c = centre.meet(b, end).value_or(lerp(b, end, 0.5));
    const auto line = [&](Vec2 tip) { return dir > 0 ? Segment{a, tip} : Segment{tip, a}; };
    return slit_folds(e.site, line(b), line(c), line(end));
}

SlitShape shape_of(const Element& e, const FoldLines& folds) {
    const int dir = direction(e);
    const Vec2 a = e.site.on_page(Side::left, e.on[A]);
    const Vec2 b = e.site.on_page(Side::left, e.on[B]);
    const Vec2 end = e.site.on_page(Side::right, e.on[E]);
    const Segment centre = folds[kCentreFold].on_left;
    const Vec2 c = dir > 0 ? centre.b : centre.a;
    SlitShape shape;
    shape.left = {a, b, c};
    shape.right = {a, c, end};
    shape.gone_left = half(e, Side::left);
    shape.gone_right = half(e, Side::right);
    shape.cuts = {{b, end}};
    shape.span = span(e);
    shape.left_bar = angled_bar(e.site, Side::left, e.on[A].s, dir, e.on[B], a, b, c);
    shape.right_bar = angled_bar(e.site, Side::right, e.on[A].s, dir, e.on[E], a, end, c);
    return shape;
}

}  // namespace beak

namespace {

constexpr std::array<PointInfo, 3> kPoints{
    {{"A", PointPage::fold, '-'}, {"B", PointPage::fold, 'L'}, {"E", PointPage::fold, 'R'}}};
constexpr std::array<int, 3> kPartners{0, 2, 1};
// Glassner's (sections 3 and 5).
constexpr std::array<std::string_view, 2> kOtherNames{"single-slit", "asymmetric-slit"};
void lower(const Element& e, Builder& builder) {
    const FoldLines folds = beak::fold_lines(e);
    lower_slit(e, builder, folds, beak::shape_of(e, folds));
}

constexpr ElementRow row(std::string_view name, int code, bool inverted, std::string_view about,
                         std::span<const std::string_view> also = {}) {
    return {{.name = name,
             .code = code,
             .family = "beak",
             .inverted = inverted,
             .glued = false,
             .about = about,
             .points = kPoints,
             .partners = kPartners,
             .also = also,
             .measures = beak::kMeasures},
            beak::span,
            beak::constrain,
            beak::fold_lines,
            nullptr,
            lower,
            nullptr,
            beak::measured,
            beak::shape};
}

}  // namespace

const ElementRow kBeak =
    row("beak", 2, false, "one cut across a valley fold; a mouth whose folds meet in a point", kOtherNames);
const ElementRow kInvertedBeak =
    row("inverted-beak", 3, true, "a beak on a mountain fold; it sinks behind it");

}  // namespace popup
