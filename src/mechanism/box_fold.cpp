// The box fold: a step with its cuts square to the fold, given by two opposite corners (Foldlings).
//
// A and B are corners on either side of the fold, in any order; the rectangle has its sides along and across
// the fold.
#include <algorithm>
#include <array>
#include <cmath>

#include "mechanism/measures.h"
#include "mechanism/rows.h"
#include "mechanism/sheet_rows.h"
#include "mechanism/step.h"

namespace popup {
namespace {

enum { A, B };  // of `on`

constexpr std::array<PointInfo, 2> kPoints{{{"A", PointPage::fold, '-'}, {"B", PointPage::fold, '-'}}};
constexpr std::array<int, 2> kPartners{0, 1};

constexpr ElementInfo kAsStep{.name = "box-fold",
                              .code = -1,
                              .family = "box fold",
                              .inverted = false,
                              .glued = false,
                              .about = {},
                              .points = step::kPoints,
                              .partners = step::kPartners};

// Which of its corners lies on the left; points without a side have w positive on the left.
std::size_t left_corner(const Element& e) { return e.on[A].w >= e.on[B].w ? A : B; }

// The step that it is.
Element as_step(const Element& e) {
    Element made = e;
    made.info = &kAsStep;
    const SitePoint l = e.on[left_corner(e)];
    const SitePoint r = e.on[1 - left_corner(e)];
    const auto [lo, hi] = std::minmax(l.s, r.s);
    made.on = {{lo, l.w}, {hi, l.w}, {lo, -r.w}, {hi, -r.w}};
    return made;
}

std::pair<double, double> span(const Element& e) { return std::minmax(e.on[A].s, e.on[B].s); }

bool constrain(Element& e) {
    const std::size_t left = left_corner(e);
    const bool left_first = e.on[left].s <= e.on[1 - left].s;
    Element made = as_step(e);
    const auto take_corners = [&] {
        e.on[left] = made.on[left_first ? step::A : step::B];
        const SitePoint right = made.on[left_first ? step::H : step::G];
        e.on[1 - left] = {right.s, -right.w};
    };
    made.repaired = [&](std::string_view code, std::string what, std::string hint) {
        take_corners();
        e.repaired(code, std::move(what), std::move(hint));
    };
    if (!step::constrain(made)) return false;
    take_corners();
    return true;
}

FoldLines fold_lines(const Element& e) { return step::fold_lines(as_step(e)); }

void lower(const Element& e, Builder& builder) { step::lower(as_step(e), builder); }

std::vector<double> crossings(const Element& e) {
    if (e.on[A].w * e.on[B].w >= 0.0) return {};
    const auto [lo, hi] = span(e);
    return {lo, hi};
}

constexpr std::array<MeasureInfo, 4> kMeasures{
    {measure::kAt, measure::kLength, measure::kWidth, measure::kOffset}};

// Points of either side have w positive on the left.
std::vector<double> measured(const Element& e) {
    const SitePoint a = e.on[A];
    const SitePoint b = e.on[B];
    return {measure::from_middle(e, 0.5 * (a.s + b.s)), std::abs(b.s - a.s), std::abs(b.w - a.w),
            -0.5 * (a.w + b.w)};
}

void shape(Element& e, std::span<const double> v) {
    const double way = e.on[B].s >= e.on[A].s ? 1.0 : -1.0;
    const double side = e.on[B].w > e.on[A].w ? 1.0 : -1.0;
    const SitePoint middle{measure::along(e, v[0]), -v[3]};
    e.on[A] = {middle.s - 0.5 * way * v[1], middle.w - 0.5 * side * v[2]};
    e.on[B] = {middle.s + 0.5 * way * v[1], middle.w + 0.5 * side * v[2]};
}

}  // namespace

const ElementRow kBoxFold = {{.name = "box-fold",
                              .code = -1,
                              .family = "box-fold",
                              .inverted = false,
                              .glued = false,
                              .about = "a box cut from one sheet, given by two opposite corners",
                              .points = kPoints,
                              .partners = kPartners,
                              .grounds = kFoundFold,
                              .since = "3.0",
                              .measures = kMeasures},
                             span,
                             constrain,
                             fold_lines,
                             nullptr,
                             lower,
                             crossings,
                             measured,
                             shape};

}  // namespace popup
