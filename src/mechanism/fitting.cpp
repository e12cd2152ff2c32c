#include "mechanism/fitting.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace popup {

void make_parallel(Element& element, std::size_t a, std::size_t b, std::string_view name) {
    SitePoint& p = element.on[a];
    SitePoint& q = element.on[b];
    const double tilt = std::atan2(std::abs(q.w - p.w), std::abs(q.s - p.s));
    const double off = 0.5 * std::abs(q.w - p.w);
    const double half = 0.5 * std::hypot(q.s - p.s, q.w - p.w);
    const bool rounding =
        off <= element.tolerances->rounding_mm || tilt <= element.tolerances->rounding_deg * kDegree;
    const double mid_s = 0.5 * (p.s + q.s);
    const double w = 0.5 * (p.w + q.w);
    const double sign = q.s < p.s ? -1.0 : 1.0;
    if (rounding) {  // keep the ends where they are along the fold: nothing visible moves
        p.w = q.w = w;
        return;
    }
    p = {mid_s - sign * half, w};
    q = {mid_s + sign * half, w};
    element.repaired(
        "not-parallel",
        fmt::format("{} is {} off the direction of its parent fold; it was turned about its midpoint", name,
                    degrees(tilt)),
        fmt::format("give both ends of {} the same distance from the fold", name));
}

double largest_that_fits(const std::function<bool(double)>& ok) {
    if (ok(1.0)) return 1.0;
    // A coarse walk finds a place that fits even where the paper has holes further in; then bisection refines
    // it.
    double bad = 1.0;
    double good = 0.0;
    for (const double t :
         {0.999, 0.99, 0.97, 0.94, 0.9, 0.85, 0.8, 0.7, 0.6, 0.5, 0.4, 0.3, 0.2, 0.1, 0.05, 0.02}) {
        if (ok(t)) {
            good = t;
            break;
        }
        bad = t;
    }
    if (good == 0.0) return 0.0;
    for (int i = 0; i < 40; ++i) {
        const double mid = 0.5 * (good + bad);
        (ok(mid) ? good : bad) = mid;
    }
    return good;
}

namespace {

constexpr std::array<Side, 2> kSides{Side::left, Side::right};

// The element with the points of `sides` scaled: across by t_w, along about fixed_s by t_s.
Element scaled(const Element& element, std::string_view sides, double t_w, double t_s, double fixed_s) {
    Element copy = element;
    std::size_t i = 0;
    for (const PointInfo& point : element.info->points) {
        if (point.page != PointPage::fold) continue;
        if (sides.find(point.side) != std::string_view::npos) {
            SitePoint& p = copy.on[i];
            p = {fixed_s + t_s * (p.s - fixed_s), t_w * p.w};
        }
        ++i;
    }
    return copy;
}

// True when a side fold of the element, or its distance from the parent fold, is below the least that folds.
bool is_sliver(const Element& element, const Footprint& footprint) {
    const double least = element.tolerances->min_length_mm;
    return std::any_of(element.on.begin(), element.on.end(),
                       [&](SitePoint p) { return p.w != 0.0 && p.w < least; }) ||
           std::any_of(kSides.begin(), kSides.end(), [&](Side side) {
               const Ring ring = footprint.half(element, side);
               for (std::size_t i = 1; i < ring.size(); ++i) {
                   if (distance(ring[i - 1], ring[i]) < least) return true;
               }
               return false;
           });
}

}  // namespace

bool fit_cut(Element& element, const Footprint& footprint) {
    const double paper = element.tolerances->paper_mm;
    const auto along_ok = [&](const Element& e, Fit fit) {
        const auto [lo, hi] = footprint.span(e);
        const double slack = fit == Fit::exact ? 0.0 : e.tolerances->rounding_mm;
        return lo >= e.alive_lo + paper - slack && hi <= e.alive_hi - paper + slack;
    };
    const auto side_ok = [&](const Element& e, Side side, Fit fit) {
        return e.paper->may_cut(side, footprint.half(e, side), fit);
    };
    const auto ok = [&](const Element& e, Fit fit) {
        return (!footprint.valid || footprint.valid(e)) && along_ok(e, fit) && side_ok(e, Side::left, fit) &&
               side_ok(e, Side::right, fit);
    };
    if (ok(element, Fit::as_drawn)) return true;

    std::string how;
    const auto attempt = [&](std::string_view sides, bool across, bool along, std::string what) {
        const double t = largest_that_fits([&](double s) {
            return ok(scaled(element, sides, across ? s : 1.0, along ? s : 1.0, footprint.fixed_s),
                      Fit::exact);
        });
        if (t == 0.0) return false;
        const Element smaller = scaled(element, sides, across ? t : 1.0, along ? t : 1.0, footprint.fixed_s);
        if (is_sliver(smaller, footprint)) return false;
        element = smaller;
        how = fmt::format("{} to {:.1f} %", what, 100.0 * t);
        return true;
    };
    bool done = false;
    if (along_ok(element, Fit::as_drawn)) {
        const bool left = side_ok(element, Side::left, Fit::as_drawn);
        const bool right = side_ok(element, Side::right, Fit::as_drawn);
        if (!left && right) done = attempt("L", true, false, "its left side was pulled towards the fold");
        if (left && !right) done = attempt("R", true, false, "its right side was pulled towards the fold");
        if (!done) done = attempt("LR", true, false, "both sides were pulled towards the fold");
    }
    done = done || attempt("LR", false, true, "it was shortened along the fold");
    done = done || attempt("LR", true, true, "it was made smaller");
    if (!done) {
        element.failed(
            "does-not-fit",
            fmt::format("there is no room for the {} here: {} of paper must remain around it, and no seam "
                        "may lie under it",
                        element.info->name, mm(paper)),
            "move it along the fold, or make what stands beside it smaller");
        return false;
    }
    element.repaired(
        "does-not-fit",
        fmt::format("the {} is larger than the planes it stands on (with {} of paper left around it); {}",
                    element.info->name, mm(paper), how),
        "make it smaller, or the paper around it larger");
    return true;
}

}  // namespace popup
