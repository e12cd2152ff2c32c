#include "mechanism/shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace popup {

double angle_at(double apex_s, int dir, SitePoint p) { return std::atan2(p.w, dir * (p.s - apex_s)); }

SitePoint at_angle(double apex_s, int dir, SitePoint p, double angle) {
    const double radius = std::hypot(p.s - apex_s, p.w);
    return {apex_s + dir * radius * std::cos(angle), radius * std::sin(angle)};
}

double crossing(SitePoint l, SitePoint r) { return along_cut(l, r, 0.0).s; }

SitePoint along_cut(SitePoint l, SitePoint r, double w) {
    const double width = l.w + r.w;
    if (std::abs(width) < 1e-12) return {0.5 * (l.s + r.s), w};
    return {l.s + (r.s - l.s) * (l.w - w) / width, w};
}

std::optional<Vec2> proper_crossing(const Segment& a, const Segment& b) {
    const Vec2 along_a = a.b - a.a;
    const Vec2 along_b = b.b - b.a;
    const double d = cross(along_a, along_b);
    if (d == 0.0) return std::nullopt;
    const double t = cross(b.a - a.a, along_b) / d;
    const double u = cross(b.a - a.a, along_a) / d;
    if (t <= 0.0 || t >= 1.0 || u <= 0.0 || u >= 1.0) return std::nullopt;
    return a.a + t * along_a;
}

std::string self_crossing(const Ring& ring, std::span<const std::string_view> letters) {
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = i + 2; j < n; ++j) {
            if (i == 0 && j + 1 == n) continue;
            const auto at = proper_crossing({ring[i], ring[i + 1]}, {ring[j], ring[(j + 1) % n]});
            if (!at) continue;
            return fmt::format("{}–{} crosses {}–{} at {}", letters[i], letters[i + 1], letters[j],
                               letters[(j + 1) % n], at_mm(*at));
        }
    }
    return {};
}

std::string at_mm(Vec2 p) {
    const auto number = [](double value) { return std::abs(value) < 0.005 ? 0.0 : value; };
    return fmt::format("({:.2f}, {:.2f}) mm", number(p.x), number(p.y));
}

std::string mm(double value) { return fmt::format("{:.2f} mm", value); }
std::string degrees(double radians) { return fmt::format("{:.2f}°", radians / kDegree); }

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

Bar angled_bar(const Site& site, Side side, double apex_s, int dir, SitePoint seam_end, Vec2 own_apex,
               Vec2 own_seam_end, Vec2 own_centre_end) {
    const DirectedLine& line = side == Side::left ? site.left : site.right;
    Bar bar;
    bar.drive = side == Side::left ? site.left_plate : site.right_plate;
    bar.fold_at = site.on_page(side, {apex_s, 0.0});
    bar.fold_dir = static_cast<double>(dir) * line.dir;
    bar.fold_out = side == Side::left ? left_of(line.dir) : right_of(line.dir);
    bar.seam_at = bar.fold_at;
    bar.seam_dir = unit(site.on_page(side, seam_end) - bar.fold_at);
    bar.own_at = own_apex;
    bar.own_seam = unit(own_seam_end - own_apex);
    bar.own_centre = unit(own_centre_end - own_apex);
    bar.near = angle_at(apex_s, dir, seam_end);
    bar.far = std::abs(std::atan2(cross(bar.own_seam, bar.own_centre), dot(bar.own_seam, bar.own_centre)));
    return bar;
}

Bar parallel_bar(const Site& site, Side side, SitePoint seam_point, Vec2 own_point, Vec2 own_along,
                 Vec2 own_across, double far) {
    const DirectedLine& line = side == Side::left ? site.left : site.right;
    Bar bar;
    bar.drive = side == Side::left ? site.left_plate : site.right_plate;
    bar.fold_at = site.on_page(side, {seam_point.s, 0.0});
    bar.fold_dir = line.dir;
    bar.fold_out = side == Side::left ? left_of(line.dir) : right_of(line.dir);
    bar.seam_at = site.on_page(side, seam_point);
    bar.seam_dir = line.dir;
    bar.own_at = own_point;
    bar.own_seam = own_along;
    bar.own_centre = own_across;
    bar.near = seam_point.w;
    bar.far = far;
    return bar;
}

FoldLines slit_folds(const Site& site, Segment left, Segment centre, Segment right) {
    const int like = site.mountain ? 360 : 0;
    FoldLines folds;
    folds[kLeftFold] = {left, left, like};
    folds[kCentreFold] = {centre, centre, 360 - like};
    folds[kRightFold] = {right, right, like};
    return folds;
}

void lower_slit(const Element& element, Builder& builder, const FoldLines& folds, SlitShape shape) {
    const Site& site = element.site;
    const int page = site.left_page;
    const int piece = builder.skeleton().draft.plates[static_cast<std::size_t>(site.left_plate)].piece;
    const std::string& id = element.paint.id;
    const int left = builder.add_plate(id + "/left", piece, page, std::move(shape.left), element.paint.left);
    const int right =
        builder.add_plate(id + "/right", piece, page, std::move(shape.right), element.paint.right);
    builder.add_cut_out(site.left_plate, site.fold, std::move(shape.gone_left));
    builder.add_cut_out(site.right_plate, site.fold, std::move(shape.gone_right));
    for (const Segment& cut : shape.cuts) builder.add_cut(piece, cut);
    const auto [lo, hi] = shape.span;
    builder.add_gone(site.fold, site.reversed ? site.length - hi : lo, site.reversed ? site.length - lo : hi,
                     id);

    const auto fold = [&](FoldRole role, int left_plate, int right_plate) {
        const FoldLine& line = folds[static_cast<std::size_t>(role)];
        builder.add_fold({left_plate,
                          right_plate,
                          page,
                          page,
                          line.on_left,
                          line.on_right,
                          line.closed_deg,
                          false,
                          id,
                          {}});
    };
    fold(kLeftFold, site.left_plate, left);
    fold(kCentreFold, left, right);
    fold(kRightFold, right, site.right_plate);

    FourBar bars{Closing::half_turn, shape.parallel, shape.left_bar, shape.right_bar};
    bars.left.plate = left;
    bars.right.plate = right;
    builder.add_joint({id, element.paint.place, bars});
}

void lower_glued(const Element& element, Builder& builder, const FoldLines& folds, GluedShape shape) {
    const Site& site = element.site;
    const std::string& id = element.paint.id;
    const int page = element.extra_page;
    const int piece = builder.add_piece(id);
    const int left = builder.add_plate(id + "/left", piece, page, std::move(shape.left), element.paint.left);
    const int right =
        builder.add_plate(id + "/right", piece, page, std::move(shape.right), element.paint.right);
    for (const Segment& edge : shape.edges) builder.add_cut(piece, edge);

    const FoldLine& l = folds[kLeftFold];
    const FoldLine& c = folds[kCentreFold];
    const FoldLine& r = folds[kRightFold];
    builder.add_fold(
        {site.left_plate, left, site.left_page, page, l.on_left, l.on_right, l.closed_deg, true, id, {}});
    builder.add_fold({left, right, page, page, c.on_left, c.on_right, c.closed_deg, false, id, {}});
    builder.add_fold(
        {right, site.right_plate, page, site.right_page, r.on_left, r.on_right, r.closed_deg, true, id, {}});

    // Glue looks along the seam with the piece on its right: the tab then lies on the left of it on the
    // piece's page, and covers the right of it on the base.
    const auto turned = [](const Segment& s) { return Segment{s.b, s.a}; };
    builder.add_glue({left, site.left_plate, l.on_right, l.on_left, element.label + "L",
                      element.paint.left_tab, id, element.paint.place});
    builder.add_glue({right, site.right_plate, turned(r.on_left), turned(r.on_right), element.label + "R",
                      element.paint.right_tab, id, element.paint.place});

    FourBar bars{site.mountain ? Closing::outside : Closing::inside, shape.parallel, shape.left_bar,
                 shape.right_bar};
    bars.left.plate = left;
    bars.right.plate = right;
    builder.add_joint({id, element.paint.place, bars});
}

}  // namespace popup
