#include "pattern/tabs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/geometry/hull.h"
#include "base/geometry/regions.h"
#include "base/geometry/tolerances.h"
#include "popup/diagnostics.h"

namespace popup {
namespace {

// Nothing thinner than this is left of a tab, and no part that holds nothing: one that stands on less than
// this much of seam, or is less deep.
constexpr double kSliverMm = 0.5;
constexpr double kLeastSeamMm = 2.0;
constexpr double kLeastDepthMm = 1.0;
// Bumps of less paper than this, or than this share of a part, are cut off.
constexpr double kBumpMm2 = 0.6;
constexpr double kBumpShare = 0.03;
// The wedge beside paper that starts at a seam's end.
constexpr double kWedge = 10.0 * std::numbers::pi / 180.0;

// The part of a segment above the seam line; false when there is none.
bool above_seam(Segment& s) {
    if (std::max(s.a.y, s.b.y) <= kSeamEndMm) return false;
    if (s.a.y < 0.0) s.a = lerp(s.a, s.b, s.a.y / (s.a.y - s.b.y));
    if (s.b.y < 0.0) s.b = lerp(s.b, s.a, s.b.y / (s.b.y - s.a.y));
    return true;
}

// Everything from the convex hull of the points outwards, as far as `reach`.
Polygon shadow(std::vector<Vec2> points, double reach) {
    const std::size_t count = points.size();
    for (std::size_t i = 0; i < count; ++i) points.push_back({points[i].x, std::max(reach, points[i].y)});
    return {convex_hull(std::move(points)), {}};
}

Polygon band_shadow(const Segment& s, double gap, double reach) {
    const double size = distance(s.a, s.b);
    const Vec2 along = size > kSeamEndMm ? gap * unit(s.b - s.a) : Vec2{gap, 0.0};
    const Vec2 across = left_of(along);
    return shadow({s.a - along + across, s.a - along - across, s.b + along + across, s.b + along - across},
                  reach);
}

// Beside paper that starts at a seam's end `corner` and ends at `end`; `inwards` is +1 or -1 along the seam.
Polygon wedge_shadow(Vec2 corner, Vec2 end, double inwards, double gap, double reach) {
    const double size = distance(corner, end);
    const Vec2 across = left_of(unit(end - corner));
    const double width = std::min(gap, size * std::tan(kWedge));
    const Vec2 towards = (across.x * inwards < 0.0 ? -width : width) * across;
    return shadow({corner, end, end + towards}, reach);
}

Polygon piece_shadow(const Segment& s, double seam_length, double gap, double reach) {
    for (const Vec2 corner : {Vec2{0.0, 0.0}, Vec2{seam_length, 0.0}}) {
        const double inwards = corner.x == 0.0 ? 1.0 : -1.0;
        if (distance(s.a, corner) <= kSeamEndMm) return wedge_shadow(corner, s.b, inwards, gap, reach);
        if (distance(s.b, corner) <= kSeamEndMm) return wedge_shadow(corner, s.a, inwards, gap, reach);
    }
    return band_shadow(s, gap, reach);
}

bool needs_cleaning(const Ring& ring) {
    // A corner that keeps its paper when eroded and grown again has more than about 29°.
    constexpr double kBluntCosine = 0.87;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 before = ring[i == 0 ? ring.size() - 1 : i - 1];
        const Vec2 after = ring[i + 1 == ring.size() ? 0 : i + 1];
        if (distance(ring[i], after) < 2.0 * kSliverMm) return true;
        if (dot(unit(before - ring[i]), unit(after - ring[i])) > kBluntCosine) return true;
        // A neck: a corner near an edge that it does not belong to.
        for (std::size_t j = 0; j < ring.size(); ++j) {
            const std::size_t k = j + 1 == ring.size() ? 0 : j + 1;
            if (j == i || k == i) continue;
            if (distance(ring[i], Segment{ring[j], ring[k]}) < kSliverMm) return true;
        }
    }
    return false;
}

// Takes away what is thinner than a sliver. Never adds paper.
std::vector<Polygon> without_slivers(const std::vector<Polygon>& parts) {
    const bool clean = std::none_of(parts.begin(), parts.end(),
                                    [](const Polygon& part) { return needs_cleaning(part.outer); });
    if (clean) return parts;
    const double half = 0.5 * kSliverMm;
    return intersect(parts, offset(offset(parts, -half, Corners::sharp), half, Corners::sharp));
}

// Rounding away from the seam and its ends is taken back.
Ring snapped(Ring ring, double seam_length) {
    for (Vec2& p : ring) {
        if (std::abs(p.y) <= kSeamEndMm) p.y = 0.0;
        if (p.y == 0.0 && std::abs(p.x) <= kSeamEndMm) p.x = 0.0;
        if (p.y == 0.0 && std::abs(p.x - seam_length) <= kSeamEndMm) p.x = seam_length;
    }
    return tidied(ring, kTidyMm);
}

bool in_triangle(Vec2 p, Vec2 a, Vec2 b, Vec2 c) {
    return cross(b - a, p - a) >= 0.0 && cross(c - b, p - b) >= 0.0 && cross(a - c, p - c) >= 0.0;
}

// Cuts off small bumps between obstacles, the smallest first: a plain outline is worth more than a corner of
// paper. Never adds paper, never touches the seam.
Ring without_bumps(Ring ring) {
    const double bump = std::min(kBumpMm2, kBumpShare * signed_area(ring));
    while (ring.size() > 4) {
        std::size_t smallest = ring.size();
        double least = bump;
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vec2 a = ring[i == 0 ? ring.size() - 1 : i - 1];
            const Vec2 p = ring[i];
            const Vec2 b = ring[i + 1 == ring.size() ? 0 : i + 1];
            const double size = 0.5 * cross(p - a, b - p);
            if (p.y == 0.0 || size <= 0.0 || size >= least) continue;
            const auto in_the_way = [&](Vec2 q) {
                return !(q == a) && !(q == p) && !(q == b) && in_triangle(q, a, p, b);
            };
            if (std::any_of(ring.begin(), ring.end(), in_the_way)) continue;
            least = size;
            smallest = i;
        }
        if (smallest == ring.size()) break;
        ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(smallest));
    }
    return ring;
}

}  // namespace

SeamFrame::SeamFrame(const Segment& seam, bool left)
    : seam_(seam),
      along_(unit(seam.b - seam.a)),
      out_(left ? left_of(along_) : right_of(along_)),
      length_(distance(seam.a, seam.b)) {}

Vec2 SeamFrame::to_page(Vec2 p) const {
    if (p.y == 0.0 && p.x == 0.0) return seam_.a;
    if (p.y == 0.0 && p.x == length_) return seam_.b;
    return seam_.a + p.x * along_ + p.y * out_;
}

Ring SeamFrame::to_page(const Ring& ring) const {
    Ring made;
    made.reserve(ring.size());
    for (const Vec2 p : ring) made.push_back(to_page(p));
    return made;
}

Vec2 SeamFrame::to_seam(Vec2 p) const { return {dot(p - seam_.a, along_), dot(p - seam_.a, out_)}; }

double SeamFrame::text_angle() const {
    const bool turned = along_.x < -1e-9 || (along_.x < 1e-9 && along_.y < 0.0);
    const Vec2 reading = turned ? -along_ : along_;
    return std::atan2(reading.y, reading.x);
}

Ring full_tab(double seam_length, const TabRules& rules) {
    const double slope = std::tan(rules.taper);
    double depth = rules.depth;
    if (slope > 0.0) depth = std::min(depth, 0.375 * seam_length / slope);
    const double inset = depth * slope;
    return {{0.0, 0.0}, {seam_length, 0.0}, {seam_length - inset, depth}, {inset, depth}};
}

std::vector<Ring> trimmed_tab(double seam_length, const TabRules& rules, std::span<const Segment> on_base,
                              std::span<const Segment> on_piece) {
    const Ring full = full_tab(seam_length, rules);
    const double depth = full[2].y;
    const double reach = depth + 1.0;
    std::vector<Polygon> shadows;
    const auto add = [&](const Segment& obstacle, bool piece) {
        Segment s = obstacle;
        if (!above_seam(s) || std::min(s.a.y, s.b.y) - rules.gap >= depth) return;
        Polygon one =
            piece ? piece_shadow(s, seam_length, rules.gap, reach) : band_shadow(s, rules.gap, reach);
        const Box box = bounds(one.outer);
        if (one.outer.size() >= 3 && box.max.x > 0.0 && box.min.x < seam_length)
            shadows.push_back(std::move(one));
    };
    for (const Segment& s : on_base) add(s, false);
    for (const Segment& s : on_piece) add(s, true);

    std::vector<Polygon> parts{{full, {}}};
    if (!shadows.empty()) parts = subtract(parts, shadows);
    parts = without_slivers(parts);
    std::vector<Ring> rings;
    for (const Polygon& part : parts) {
        POPUP_INVARIANT(part.holes.empty());  // shadows reach out of the tab
        const Ring ring = without_bumps(snapped(part.outer, seam_length));
        double standing = 0.0;
        for (const Stretch& s : seam_stretches({&ring, 1})) standing += s.to - s.from;
        if (standing < std::min(kLeastSeamMm, 0.5 * seam_length)) continue;
        if (bounds(ring).height() < std::min(kLeastDepthMm, 0.5 * depth)) continue;
        rings.push_back(ring);
    }
    return rings;
}

std::vector<Stretch> seam_stretches(std::span<const Ring> parts) {
    std::vector<Stretch> stretches;
    for (const Ring& ring : parts) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            const Vec2 next = ring[i + 1 == ring.size() ? 0 : i + 1];
            if (ring[i].y == 0.0 && next.y == 0.0 && next.x > ring[i].x)
                stretches.push_back({ring[i].x, next.x});
        }
    }
    std::sort(stretches.begin(), stretches.end(),
              [](const Stretch& a, const Stretch& b) { return a.from < b.from; });
    return stretches;
}

double length_with_depth(std::span<const Ring> parts, double depth) {
    double total = 0.0;
    for (const Ring& ring : parts) {
        for (std::size_t i = 0; i < ring.size(); ++i) {
            Vec2 a = ring[i];
            Vec2 b = ring[i + 1 == ring.size() ? 0 : i + 1];
            if (std::max(a.y, b.y) < depth) continue;
            if (a.y < depth) a = lerp(a, b, (depth - a.y) / (b.y - a.y));
            if (b.y < depth) b = lerp(b, a, (depth - b.y) / (a.y - b.y));
            total += a.x - b.x;  // the far side runs backwards
        }
    }
    return total;
}

double least_depth(const Ring& part, double from, double to) {
    const Box box = bounds(part);
    if (from < box.min.x || to > box.max.x) return 0.0;
    double least = box.max.y;
    for (std::size_t i = 0; i < part.size(); ++i) {
        Vec2 a = part[i];
        Vec2 b = part[i + 1 == part.size() ? 0 : i + 1];
        if (a.y == 0.0 && b.y == 0.0) continue;
        if (a.x > b.x) std::swap(a, b);
        if (b.x < from || a.x > to) continue;
        if (a.x < from) a = lerp(a, b, (from - a.x) / (b.x - a.x));
        if (b.x > to) b = lerp(b, a, (b.x - to) / (b.x - a.x));
        least = std::min({least, a.y, b.y});
    }
    return least;
}

}  // namespace popup
