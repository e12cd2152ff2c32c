#include "mechanism/angled.h"

#include <fmt/format.h>

#include "mechanism/fitting.h"

namespace popup {

bool put_apex_on_fold(Element& e, std::size_t point, std::string_view letter) {
    SitePoint& apex = e.on[point];
    const double off = std::abs(apex.w);
    apex.w = 0.0;
    if (off > e.tolerances->rounding_mm) {
        e.repaired(
            "apex-off-fold",
            fmt::format("the apex {} lies {} beside the parent fold; it was moved onto it", letter, mm(off)),
            fmt::format("choose {} on the fold", letter));
    }
    if (apex.s < e.alive_lo - e.tolerances->rounding_mm || apex.s > e.alive_hi + e.tolerances->rounding_mm) {
        e.failed("fold-too-short",
                 fmt::format("the apex {} lies {} beyond the end of its fold", letter,
                             mm(std::max(e.alive_lo - apex.s, apex.s - e.alive_hi))),
                 "move the apex onto the fold");
        return false;
    }
    return true;
}

bool angled_degenerate(Element& e, std::string_view line, double size, double angle) {
    e.failed(
        "degenerate",
        fmt::format(
            "the {} is too small to fold: {} is {} long, at {} to the fold; the least is {} and {:.0f}°, "
            "and {} between its ends and the fold",
            e.info->name, line, mm(size), degrees(angle), mm(e.tolerances->min_length_mm),
            e.tolerances->min_angle_deg, mm(e.tolerances->min_length_mm)),
        "put the left points left and the right points right of the fold, further away from it");
    return false;
}

bool close_opening(Element& e, double apex_s, int dir, std::initializer_list<std::size_t> left,
                   std::initializer_list<std::size_t> right, double limit_deg) {
    const double a = angle_at(apex_s, dir, e.on[*(left.end() - 1)]);
    const double b = angle_at(apex_s, dir, e.on[*(right.end() - 1)]);
    const double excess = a + b - limit_deg * kDegree;
    if (excess <= e.tolerances->rounding_deg * kDegree) return true;
    const double least = e.tolerances->min_angle_deg * kDegree;
    const double half = 0.5 * excess;
    if (a - half < least || b - half < least) {
        return angled_degenerate(e, "one side", 0.0, std::min(a, b) - half);
    }
    for (const std::size_t i : left) e.on[i] = at_angle(apex_s, dir, e.on[i], a - half);
    for (const std::size_t i : right) e.on[i] = at_angle(apex_s, dir, e.on[i], b - half);
    e.repaired(
        "opening-too-wide",
        fmt::format(
            "its sides open by {} about the apex, {:.0f}° is the most that folds; both were turned in by "
            "{}",
            degrees(a + b), limit_deg, degrees(half)),
        "choose the outer points nearer to the fold");
    return true;
}

bool opens_within(const Element& e, double apex_s, int dir, std::size_t left, std::size_t right) {
    const double sum = angle_at(apex_s, dir, e.on[left]) + angle_at(apex_s, dir, e.on[right]);
    return sum <= (kWidestSlit + e.tolerances->rounding_deg) * kDegree;
}

std::optional<Vec2> SlitCentre::meet(Vec2 p, Vec2 q) const {
    const Vec2 along = q - p;
    const double d = cross(dir, along);
    if (d == 0.0) return std::nullopt;
    const double t = cross(p - at, dir) / d;
    if (t < 0.0 || t > 1.0) return std::nullopt;
    return p + t * along;
}

SlitCentre slit_centre(const Site& site, double apex_s, int dir, SitePoint left, SitePoint right) {
    // Turned from the fold towards the left by a - b: g = b away from the left side, h = a from the right
    // one.
    const double turn = angle_at(apex_s, dir, left) - angle_at(apex_s, dir, right);
    const Vec2 along = static_cast<double>(dir) * site.left.dir;
    return {site.on_page(Side::left, {apex_s, 0.0}),
            std::cos(turn) * along + std::sin(turn) * left_of(site.left.dir)};
}

}  // namespace popup
