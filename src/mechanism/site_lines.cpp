#include "mechanism/site_lines.h"

#include <fmt/format.h>

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

std::string mm(double value) {
    constexpr double kHalfOfLast = 0.005;
    return fmt::format("{:.2f} mm", std::abs(value) < kHalfOfLast ? 0.0 : value);  // never "-0.00"
}
std::string degrees(double radians) { return fmt::format("{:.2f}°", radians / kDegree); }

}  // namespace popup
