// The step: two cuts across the fold, two side folds and a centre fold, all parallel (thesis 5.4.3.1).
//
// Points A B on the left side fold, G H on the right one; A–G and B–H are the cuts. With p and q the
// distances of the side folds from the parent fold, the centre fold lies q from the left one and p from the
// right one, so that the four folds are a parallelogram's corners at every angle.
#include "mechanism/step.h"

#include <fmt/format.h>

#include <algorithm>

#include "mechanism/fitting.h"
#include "mechanism/rows.h"
#include "mechanism/shapes.h"

namespace popup {

namespace step {

std::vector<double> measured(const Element& e) {
    const measure::TwoSides m = measure::two_sides(e);
    return {m.at, m.length, m.width, m.offset, m.shift, m.taper};
}

void shape(Element& e, std::span<const double> v) {
    measure::set_two_sides(e, {v[0], v[1], v[2], v[3], v[4], v[5]});
}

std::pair<double, double> span(const Element& e) {
    return std::minmax({crossing(e.on[A], e.on[G]), crossing(e.on[B], e.on[H])});
}

namespace {

// The half of the element on one side: from the fold along one cut, the side fold, and back along the other
// cut.
Ring half(const Element& e, Side side) {
    const bool left = side == Side::left;
    const SitePoint a = e.on[left ? A : G];
    const SitePoint b = e.on[left ? B : H];
    return {e.site.on_page(side, {crossing(e.on[A], e.on[G]), 0.0}), e.site.on_page(side, a),
            e.site.on_page(side, b), e.site.on_page(side, {crossing(e.on[B], e.on[H]), 0.0})};
}

// Clips what overflows the fold's ends: a cut that crosses the fold too far out moves along it, both ends
// alike.
void clip_along(Element& e) {
    const double lo = e.alive_lo + e.tolerances->paper_mm;
    const double hi = e.alive_hi - e.tolerances->paper_mm;
    double most = 0.0;
    for (const auto& [l, r] : {std::pair{A, G}, std::pair{B, H}}) {
        const double at = crossing(e.on[l], e.on[r]);
        const double move = std::clamp(at, std::min(lo, hi), hi) - at;
        if (std::abs(move) <= e.tolerances->rounding_mm) continue;
        e.on[l].s += move;
        e.on[r].s += move;
        most = std::max(most, std::abs(move));
    }
    if (most == 0.0) return;
    e.repaired(
        "does-not-fit",
        fmt::format(
            "the {} reaches {} over the end of its fold (with {} of paper left around it); it was clipped",
            e.info->family, mm(most), mm(e.tolerances->paper_mm)),
        "make it shorter along the fold");
}

}  // namespace

bool constrain(Element& e) {
    const double least = e.tolerances->min_length_mm;
    if ((e.on[A].s - e.on[B].s) * (e.on[G].s - e.on[H].s) < 0.0) {
        const Segment ag{e.site.on_page(Side::left, e.on[A]), e.site.on_page(Side::right, e.on[G])};
        const Segment bh{e.site.on_page(Side::left, e.on[B]), e.site.on_page(Side::right, e.on[H])};
        const Vec2 at = proper_crossing(ag, bh).value_or(0.5 * (ag.a + ag.b));
        e.failed("outline-crosses", "the cuts A–G and B–H cross at " + at_mm(at),
                 "put A and G at the ends of one cut, B and H at those of the other");
        return false;
    }
    make_parallel(e, A, B, "the left fold A–B");
    make_parallel(e, G, H, "the right fold G–H");
    const double p = e.on[A].w;
    const double q = e.on[G].w;
    const double left_length = std::abs(e.on[A].s - e.on[B].s);
    const double right_length = std::abs(e.on[G].s - e.on[H].s);
    if (std::min({p, q, left_length, right_length}) < least) {
        e.failed(
            "degenerate",
            fmt::format("the {} is too small to fold: side folds {} and {} long, {} and {} from the parent "
                        "fold, where {} is the least",
                        e.info->family, mm(left_length), mm(right_length), mm(p), mm(q), mm(least)),
            "put A, B left and G, H right of the fold, each side fold at least 1 mm long and 1 mm away from "
            "it");
        return false;
    }
    clip_along(e);
    // A cut that is oblique may have been moved past an end of the other.
    const double left = e.on[A].s - e.on[B].s;
    const double right = e.on[G].s - e.on[H].s;
    if (left * right < 0.0 || std::min(std::abs(left), std::abs(right)) < least) {
        e.failed("does-not-fit",
                 fmt::format("too little of the fold is left where the {} stands", e.info->family),
                 "move it along the fold");
        return false;
    }
    const auto [lo, hi] = span(e);
    return fit_cut(e, {half, span, 0.5 * (lo + hi)});
}

FoldLines fold_lines(const Element& e) {
    const bool up = e.on[B].s >= e.on[A].s;
    const auto line = [&](Vec2 a, Vec2 b) { return up ? Segment{a, b} : Segment{b, a}; };
    const Vec2 a = e.site.on_page(Side::left, e.on[A]);
    const Vec2 b = e.site.on_page(Side::left, e.on[B]);
    const Vec2 g = e.site.on_page(Side::right, e.on[G]);
    const Vec2 h = e.site.on_page(Side::right, e.on[H]);
    const double p = 0.5 * (e.on[A].w + e.on[B].w);
    const double q = 0.5 * (e.on[G].w + e.on[H].w);
    const double t = std::abs(p + q) > 1e-9 ? q / (p + q) : 0.5;
    return slit_folds(e.site, line(a, b), line(lerp(a, g, t), lerp(b, h, t)), line(g, h));
}

void lower(const Element& e, Builder& builder) {
    const FoldLines folds = fold_lines(e);
    const Segment l = folds[kLeftFold].on_left;
    const Segment c = folds[kCentreFold].on_left;
    const Segment r = folds[kRightFold].on_left;
    SlitShape shape;
    shape.left = {l.a, l.b, c.b, c.a};
    shape.right = {c.a, c.b, r.b, r.a};
    shape.gone_left = half(e, Side::left);
    shape.gone_right = half(e, Side::right);
    shape.cuts = {{l.a, r.a}, {l.b, r.b}};
    shape.span = span(e);
    shape.parallel = true;
    const Vec2 along = e.site.left.dir;
    shape.left_bar = parallel_bar(e.site, Side::left, e.on[A], e.site.on_page(Side::left, e.on[A]), along,
                                  right_of(along), e.on[G].w);
    shape.right_bar = parallel_bar(e.site, Side::right, e.on[G], e.site.on_page(Side::right, e.on[G]), along,
                                   left_of(along), e.on[A].w);
    lower_slit(e, builder, folds, std::move(shape));
}

}  // namespace step

namespace {

// Glassner's (section 7).
constexpr std::array<std::string_view, 1> kOtherNames{"double-slit"};

constexpr ElementRow row(std::string_view name, int code, bool inverted, std::string_view about,
                         std::span<const std::string_view> also = {}) {
    return {{.name = name,
             .code = code,
             .family = "step",
             .inverted = inverted,
             .glued = false,
             .about = about,
             .points = step::kPoints,
             .partners = step::kPartners,
             .also = also,
             .measures = step::kMeasures},
            step::span,
            step::constrain,
            step::fold_lines,
            nullptr,
            step::lower,
            nullptr,
            step::measured,
            step::shape};
}

}  // namespace

const ElementRow kStep =
    row("step", 0, false, "two cuts across a valley fold; a box that stands out of the page", kOtherNames);
const ElementRow kInvertedStep =
    row("inverted-step", 1, true, "a step on a mountain fold; it sinks behind it");

}  // namespace popup
