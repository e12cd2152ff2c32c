#include "mechanism/two_seams.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <tuple>

#include "mechanism/fitting.h"
#include "mechanism/shapes.h"
#include "mechanism/silhouette.h"
#include "mechanism/walls.h"

namespace popup::two_seams {
namespace {

constexpr std::array<std::string_view, 4> kRing{"G", "K", "L", "H"};

// +1 when A–B runs along the fold, -1 when against it.
double heading(const Element& e) { return e.on[B].s >= e.on[A].s ? 1.0 : -1.0; }

// Along the piece's seams, in the direction of the parent fold; across it, from the left seam towards the
// right one.
struct PieceAxes {
    Vec2 along, across;
};
PieceAxes axes(const Element& e) {
    const Vec2 along = heading(e) * unit(e.extra[H] - e.extra[G]);
    return {along, right_of(along)};
}

// s1: from the left seam to the centre fold.
double left_far(const Element& e) {
    const double p = 0.5 * (e.on[A].w + e.on[B].w);
    const double q = 0.5 * (e.on[E].w + e.on[F].w);
    return 0.5 * (width(e) + (e.site.mountain ? p - q : q - p));
}

bool degenerate(Element& e, std::string what) {
    e.failed("degenerate", fmt::format("the {} is too small to fold: {}", e.info->name, what),
             "put A, B left and E, F right of the fold, each seam at least 1 mm long and 1 mm away from it");
    return false;
}

// Takes from both ends of a seam what hangs over its plane.
bool fit_seam(Element& e, Side side, std::size_t i, std::size_t j, std::string_view name) {
    const SitePoint p = e.on[i];
    const SitePoint q = e.on[j];
    const auto on = [](SitePoint a, SitePoint b, double t, double w) {
        return SitePoint{a.s + t * (b.s - a.s), w};
    };
    if (e.paper->may_glue(side, e.site.segment(side, p, q), Fit::as_drawn)) return true;
    const auto ok = [&](SitePoint a, SitePoint b) {
        return e.paper->may_glue(side, e.site.segment(side, a, b), Fit::exact);
    };
    // First pull the seam towards the fold until its middle is on paper, then clip its ends.
    const SitePoint mid = on(p, q, 0.5, p.w);
    const SitePoint near_mid = on(p, q, 0.501, p.w);
    const double t = largest_that_fits([&](double u) { return ok({mid.s, u * p.w}, {near_mid.s, u * p.w}); });
    const double w = t * p.w;
    if (t == 0.0 || w < e.tolerances->min_length_mm) {
        e.failed("does-not-fit", fmt::format("there is no paper under the seam {}", name),
                 fmt::format("move the {} along the fold, or what has been cut out beside it", e.info->name));
        return false;
    }
    const SitePoint middle{mid.s, w};
    const double to_p = largest_that_fits([&](double u) { return ok(middle, on(middle, p, u, w)); });
    const double to_q = largest_that_fits([&](double u) { return ok(middle, on(middle, q, u, w)); });
    e.on[i] = on(middle, p, to_p, w);
    e.on[j] = on(middle, q, to_q, w);
    if (std::abs(e.on[i].s - e.on[j].s) < e.tolerances->min_length_mm) {
        e.failed("does-not-fit", fmt::format("there is no paper under the seam {}", name),
                 fmt::format("move the {} along the fold, or what has been cut out beside it", e.info->name));
        return false;
    }
    // What the repair leaves alone is not told as if it had changed.
    const auto now = [](const std::string& is, const std::string& was, std::string_view what) {
        return is == was ? fmt::format("still {} {}", is, what)
                         : fmt::format("now {} {} (was {})", is, what, was);
    };
    e.repaired("does-not-fit",
               fmt::format("the seam {} leaves the plane it is glued to; it is {} and {}", name,
                           now(mm(w), mm(p.w), "from the fold"),
                           now(mm(std::abs(e.on[i].s - e.on[j].s)), mm(std::abs(p.s - q.s)), "long")),
               fmt::format("make the {} smaller, or the paper under it larger", e.info->name));
    return true;
}

// Turns G–H and K–L about their midpoints until both run in their mean direction.
void make_piece_parallel(Element& e) {
    const Vec2 gh = e.extra[H] - e.extra[G];
    const Vec2 kl = e.extra[L] - e.extra[K];
    const double between = std::atan2(cross(gh, kl), dot(gh, kl));
    if (between == 0.0) return;
    const auto turn = [&](std::size_t i, std::size_t j, double angle) {
        const Vec2 mid = 0.5 * (e.extra[i] + e.extra[j]);
        e.extra[i] = mid + rotated(e.extra[i] - mid, angle);
        e.extra[j] = mid + rotated(e.extra[j] - mid, angle);
    };
    turn(G, H, 0.5 * between);
    turn(K, L, -0.5 * between);
    const double off = 0.25 * std::abs(between) * std::max(length(gh), length(kl));
    if (off <= e.tolerances->rounding_mm || std::abs(between) <= e.tolerances->rounding_deg * kDegree) return;
    e.repaired(
        "not-parallel",
        fmt::format("the seams G–H and K–L of its piece are {} from parallel; both were turned about their "
                    "midpoints",
                    degrees(std::abs(between))),
        "draw G–H and K–L parallel");
}

// Moves the piece's seam ends along the seams until they match the page's, end for end.
void match_ends(Element& e) {
    const auto [along, across] = axes(e);
    std::array<double, 4> shift{};
    for (const auto& [x, on] : {std::pair{G, A}, std::pair{H, B}, std::pair{K, E}, std::pair{L, F}}) {
        shift[x] = dot(along, e.extra[x]) - e.on[on].s;
    }
    // The median leaves alone what already fits: one end that is off does not move the other three.
    std::array<double, 4> order = shift;
    std::sort(order.begin(), order.end());
    const double common = 0.5 * (order[1] + order[2]);
    double worst = 0.0;
    for (std::size_t x = 0; x < 4; ++x) {
        e.extra[x] = e.extra[x] + (common - shift[x]) * along;
        worst = std::max(worst, std::abs(common - shift[x]));
    }
    if (worst > e.tolerances->rounding_mm) {
        e.repaired(
            "seam-length",
            fmt::format(
                "the ends of the piece's seams are up to {} off those on the page; they were moved along "
                "the seams",
                mm(worst)),
            "make G–H as long as A–B, K–L as long as E–F, and offset them alike");
    }
}

PieceLines piece_lines(const Element& e) {
    const double wide = width(e);
    const double t = std::abs(wide) > 1e-9 ? left_far(e) / wide : 0.5;
    return {{e.extra[G], e.extra[H]},
            {e.extra[K], e.extra[L]},
            "G–H",
            "K–L",
            lerp(e.extra[G], e.extra[K], t),
            axes(e).along};
}

Halves halves_of(const Element& e, const FoldLines& folds) {
    if (auto drawn = silhouette_of(e, piece_lines(e))) return std::move(drawn->halves);
    const Segment& left = folds[kLeftFold].on_right;
    const Segment& centre = folds[kCentreFold].on_left;
    const Segment& right = folds[kRightFold].on_left;
    return {{{left.a, left.b, centre.b, centre.a}, {}},
            {{centre.a, centre.b, right.b, right.a}, {}},
            {{left.a, right.a}, {left.b, right.b}}};
}

}  // namespace

std::vector<double> measured(const Element& e) {
    const measure::TwoSides m = measure::two_sides(e);
    const auto& x = e.extra;
    const Vec2 middle = 0.25 * (x[G] + x[H] + x[K] + x[L]);
    return {m.at,     m.length, m.width,
            m.offset, m.shift,  m.taper,
            middle.x, middle.y, measure::turn_of(axes(e).along)};
}

void shape(Element& e, std::span<const double> v, double wide) {
    const bool drawn = e.extra[G] != e.extra[H];
    const measure::TwoSides sides{v[0], v[1], v[2], v[3], v[4], v[5]};
    measure::set_two_sides(e, sides);
    const std::array<Vec2, 3> before{e.extra[G], e.extra[H], e.extra[K]};
    const measure::Spot spot{{v[6], v[7]}, v[8]};
    const double middle = measure::along(e, sides.at);
    for (const auto& [x, on, aside] : {std::tuple{G, A, -0.5}, {H, B, -0.5}, {K, E, 0.5}, {L, F, 0.5}})
        e.extra[x] = spot.place(aside * wide, e.on[on].s - middle);
    if (!drawn) return;
    if (const auto map = measure::mapped_to(before, {e.extra[G], e.extra[H], e.extra[K]}))
        measure::move_drawn(e, PointPage::extra, *map);
}

std::pair<double, double> stands_on(const Element& e) {
    const auto [lo, hi] = std::minmax({e.on[A].s, e.on[B].s, e.on[E].s, e.on[F].s});
    return {0.5 * (lo + hi), 0.5 * (lo + hi)};
}

double width(const Element& e) {
    return dot(axes(e).across, 0.5 * (e.extra[K] + e.extra[L] - e.extra[G] - e.extra[H]));
}

double apart(const Element& e) { return e.on[A].w + e.on[E].w; }

bool constrain_page(Element& e) {
    const double least = e.tolerances->min_length_mm;
    make_parallel(e, A, B, "the seam A–B");
    make_parallel(e, E, F, "the seam E–F");
    const double left = std::abs(e.on[A].s - e.on[B].s);
    const double right = std::abs(e.on[E].s - e.on[F].s);
    if (std::min({left, right, e.on[A].w, e.on[E].w}) < least) {
        return degenerate(e, fmt::format("seams {} and {} long, {} and {} from the fold", mm(left), mm(right),
                                         mm(e.on[A].w), mm(e.on[E].w)));
    }
    if (heading(e) * (e.on[F].s - e.on[E].s) < 0.0) {
        e.failed("outline-crosses",
                 "the seams A–B and E–F run in opposite directions, so that the free edges cross",
                 "put A and E at one end of the seams, B and F at the other");
        return false;
    }
    return fit_seam(e, Side::left, A, B, "A–B") && fit_seam(e, Side::right, E, F, "E–F");
}

bool constrain_page(Element& e, const std::function<bool(Element&)>& move, std::string_view no_paper) {
    // Twice is enough where there is any paper.
    constexpr int kRounds = 4;
    for (int round = 0; round < kRounds; ++round) {
        if (!constrain_page(e) || !move(e)) return false;
        if (walls::feet_fit(e)) return true;
    }
    e.failed("does-not-fit", std::string(no_paper),
             fmt::format("move the {} along the fold, or what has been cut out beside it", e.info->name));
    return false;
}

bool constrain_piece(Element& e) {
    for (const auto& [i, j] : {std::pair{G, H}, std::pair{K, L}}) {
        const double size = distance(e.extra[i], e.extra[j]);
        if (size < e.tolerances->min_length_mm)
            return degenerate(e, fmt::format("a seam of its piece is {} long", mm(size)));
    }
    if (dot(e.extra[H] - e.extra[G], e.extra[L] - e.extra[K]) < 0.0) {
        e.failed("outline-crosses",
                 "the seams G–H and K–L of its piece run in opposite directions, so that G–K and H–L cross",
                 "put G and K at one end of the piece, H and L at the other");
        return false;
    }
    if (width(e) < 0.0) {
        mirror_piece(e);
        e.repaired("piece-mirrored",
                   "its piece was drawn from the back (K–L on the wrong side of G–H); it was mirrored",
                   "draw the printed side: with G–H upwards, K–L on its right");
    }
    make_piece_parallel(e);
    match_ends(e);
    if (const std::string what = self_crossing({e.extra[G], e.extra[K], e.extra[L], e.extra[H]}, kRing);
        !what.empty()) {
        e.failed("outline-crosses", "the outline of its piece crosses itself: " + what,
                 "draw G K L H in this order round the piece");
        return false;
    }
    return true;
}

bool constrain_outline(Element& e) {
    if (has_silhouette(e) && !constrain_silhouette(e, piece_lines(e))) return false;
    if (!has_silhouette(e) && find_argument(*e.info, e.arguments, "hole") == nullptr) return true;
    const FoldLines folds = fold_lines(e);
    return constrain_holes(e, halves_of(e, folds), folds[kCentreFold].on_left);
}

void make_even(Element& e, std::string_view why) {
    const double p = e.on[A].w;
    const double q = e.on[E].w;
    if (p == q) return;
    const double both = std::min(p, q);
    e.on[A].w = e.on[B].w = e.on[E].w = e.on[F].w = both;
    if (std::abs(p - q) <= e.tolerances->rounding_mm) return;
    e.repaired("seams-uneven",
               fmt::format("its seams are {} and {} away from the {}; both are now {} away", mm(p), mm(q),
                           why, mm(both)),
               "put both seams at the same distance from the fold");
}

std::pair<double, double> common_stretch(const Element& e) {
    const auto [left_lo, left_hi] = std::minmax(e.on[A].s, e.on[B].s);
    const auto [right_lo, right_hi] = std::minmax(e.on[E].s, e.on[F].s);
    return {std::max(left_lo, right_lo), std::min(left_hi, right_hi)};
}

bool runs_along(const Element& e) { return heading(e) > 0.0; }

void set_width(Element& e, double wide) {
    const Vec2 out = 0.5 * (wide - width(e)) * axes(e).across;
    e.extra[G] = e.extra[G] - out;
    e.extra[H] = e.extra[H] - out;
    e.extra[K] = e.extra[K] + out;
    e.extra[L] = e.extra[L] + out;
}

FoldLines fold_lines(const Element& e) {
    const bool up = heading(e) > 0.0;
    const auto line = [&](const Segment& s) { return up ? s : Segment{s.b, s.a}; };
    const double wide = width(e);
    const double t = std::abs(wide) > 1e-9 ? left_far(e) / wide : 0.5;
    Segment centre = line({lerp(e.extra[G], e.extra[K], t), lerp(e.extra[H], e.extra[L], t)});
    if (const auto drawn = silhouette_of(e, piece_lines(e))) centre = drawn->centre;
    const int seams = e.site.mountain ? 180 : 0;
    FoldLines folds(kThreeFolds.size());
    folds[kLeftFold] = {line(e.site.segment(Side::left, e.on[A], e.on[B])), line({e.extra[G], e.extra[H]}),
                        seams};
    folds[kCentreFold] = {centre, centre, 360};
    folds[kRightFold] = {line({e.extra[K], e.extra[L]}), line(e.site.segment(Side::right, e.on[E], e.on[F])),
                         seams};
    return folds;
}

void lower(const Element& e, Builder& builder, bool right_angle) {
    const FoldLines folds = fold_lines(e);
    const auto [along, across] = axes(e);
    const double far = left_far(e);
    GluedShape shape;
    shape.halves = halves_of(e, folds);
    shape.holes = holes_of(e, shape.halves, folds[kCentreFold].on_left).value();
    shape.parallel = true;
    shape.right_angle = right_angle;
    shape.left_bar = parallel_bar(e.site, Side::left, e.on[A], e.extra[G], along, across, far);
    shape.right_bar = parallel_bar(e.site, Side::right, e.on[E], e.extra[K], along, -across, width(e) - far);
    lower_glued(e, builder, folds, std::move(shape));
}

}  // namespace popup::two_seams
